// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/lone_argument.hpp"

#include "generator/constant_value.hpp"

namespace algest::lab {

namespace {

using exact::Rational;
using formula::Formula;
using formula::Kind;

/// slope * mover + offset.
struct Affine {
    std::string mover = {};   ///< text of the signal or derivative; empty: none
    Rational slope = 0;
    Rational offset = 0;
    bool known = true;        ///< slope and offset are these numbers; else parameters are in them
};

class Reader {
public:
    Reader(const model::Model& model, const std::function<bool(int)>& moves) : model_(model), moves_(moves) {}

    std::optional<Affine> read(const Formula& f) const {
        if (const auto value = model::constant_value(model_, f)) return Affine{"", 0, *value};
        if (no_signal_in(f)) return Affine{"", 0, 0, false};
        switch (f->kind) {
            case Kind::name: return mover(f, f->name);
            case Kind::call: return f->name == "der" ? mover(f, f->arguments[0]->name) : std::nullopt;
            case Kind::negate: return scaled(read(f->arguments[0]), Affine{"", 0, -1});
            case Kind::add: return sum(read(f->arguments[0]), read(f->arguments[1]));
            case Kind::subtract: return sum(read(f->arguments[0]), scaled(read(f->arguments[1]), Affine{"", 0, -1}));
            case Kind::multiply: {
                const bool left = no_signal_in(f->arguments[0]);
                return scaled(read(f->arguments[left ? 1 : 0]), read(f->arguments[left ? 0 : 1]));
            }
            case Kind::divide: return scaled(read(f->arguments[0]), inverse(read(f->arguments[1])));
            default: return std::nullopt;
        }
    }

private:
    bool no_signal_in(const Formula& f) const {
        if (f->kind == Kind::name && model_.signal(f->name) != nullptr) return false;
        for (const Formula& a : f->arguments) if (!no_signal_in(a)) return false;
        return true;
    }

    std::optional<Affine> mover(const Formula& f, const std::string& signal) const {
        if (!moves_(model_.signal_index(signal))) return std::nullopt;
        return Affine{formula::text(f), 1, 0};
    }

    static std::optional<Affine> sum(std::optional<Affine> a, const std::optional<Affine>& b) {
        if (!a || !b || (!a->mover.empty() && !b->mover.empty() && a->mover != b->mover)) return std::nullopt;
        if (a->mover.empty()) a->mover = b->mover;
        a->slope = a->slope + b->slope;
        a->offset = a->offset + b->offset;
        a->known = a->known && b->known;
        return a;
    }

    static std::optional<Affine> scaled(std::optional<Affine> a, const std::optional<Affine>& factor) {
        if (!a || !factor || !factor->mover.empty()) return std::nullopt;
        a->slope = a->slope * factor->offset;
        a->offset = a->offset * factor->offset;
        a->known = a->known && factor->known;
        return a;
    }

    static std::optional<Affine> inverse(std::optional<Affine> a) {
        if (!a || !a->mover.empty() || (a->known && cln::zerop(a->offset))) return std::nullopt;
        if (a->known) a->offset = 1 / a->offset;
        return a;
    }

    const model::Model& model_;
    const std::function<bool(int)>& moves_;
};

}  // namespace

std::optional<LoneArgument> lone_argument(const model::Model& model, const Formula& argument, const std::function<bool(int)>& moves) {
    const std::optional<Affine> a = Reader(model, moves).read(argument);
    if (!a || a->mover.empty()) return std::nullopt;
    if (!a->known) return LoneArgument{formula::text(argument), false};
    if (cln::zerop(a->slope)) return std::nullopt;
    return LoneArgument{a->mover + " = " + exact::decimal(-a->offset / a->slope), cln::minusp(a->slope)};
}

}  // namespace algest::lab
