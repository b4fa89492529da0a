// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/effect_term.hpp"

#include <algorithm>

#include "generator/constant_value.hpp"
#include "generator/dimension.hpp"
#include "generator/equation.hpp"
#include "generator/model.hpp"
#include "generator/suggestion.hpp"
#include "lab/placeholders.hpp"
#include "lab/roles.hpp"

namespace algest::lab {

namespace {

using formula::Formula;
using formula::Kind;

/// The signal of the probe that stands for the equation's other side; no role, parameter or scan may have its name.
constexpr const char* other_side = "equation";

class TermCheck {
public:
    TermCheck(const Effect& effect, const std::string& text, const Placeholders& placeholders, const toml::node& node, model::TomlAccess& file, std::set<std::string>& used)
        : effect_(effect), text_(text), placeholders_(placeholders), at_(model::position(node)), places_(file.places(node, text.size())), file_(file), used_(used) {
        for (const EffectParameter& p : effect.parameters) names_.push_back(p.name);
        for (const EffectScan& s : effect.scans) names_.push_back(s.name);
    }

    void run() {
        const auto plain = in_parentheses();
        if (!plain) return;
        const auto complain = [&](int offset, const std::string& what, const std::string& right) { complain_at(offset, what, right); };
        const auto formula = formula::parse(*plain, complain);
        if (!formula || !names_exist(*formula)) return;
        model::Model probe = probe_of(*formula);
        if (!model::check_constants(probe, *formula, complain) || !is_linear(probe) || !file_.sound()) return;
        for (const std::string& unit : effect_.units) if (!check_unit(probe, unit)) return;
    }

private:
    void complain_at(int offset, const std::string& what, const std::string& right) {
        file_.error(places_[std::min(static_cast<std::size_t>(std::max(offset, 0)), places_.size() - 1)], what, right);
    }

    std::string listed() const {
        std::string out;
        for (const auto& [name, units] : placeholders_) out += (out.empty() ? "{" : ", {") + name + "}";
        return out.empty() ? "none is declared under [roles]" : "placeholders here: " + out;
    }

    /// Each {name} as (name), which is as long, so that places stay; nullopt after a complaint.
    std::optional<std::string> in_parentheses() {
        std::string out = text_;
        for (std::size_t open = out.find_first_of("{}"); open != std::string::npos; open = out.find_first_of("{}", open + 1)) {
            const std::size_t close = out.find_first_of("{}", open + 1);
            if (out[open] == '}' || close == std::string::npos || out[close] == '{') {
                complain_at(static_cast<int>(open), out[open] == '}' ? "'}' without '{'" : "'{' is never closed", "a placeholder is written {speed}");
                return std::nullopt;
            }
            const std::string name = out.substr(open + 1, close - open - 1);
            if (placeholders_.count(name) == 0) {
                std::vector<std::string> known;
                for (const auto& [k, units] : placeholders_) known.push_back(k);
                complain_at(static_cast<int>(open), "nothing stands for " + quoted("{" + name + "}"), did_you_mean(name, known) + listed());
                return std::nullopt;
            }
            out[open] = '(';
            out[close] = ')';
        }
        return out;
    }

    bool is_placeholder(const Formula& f) const { return f->kind == Kind::name && f->offset > 0 && text_[static_cast<std::size_t>(f->offset) - 1] == '{'; }

    bool names_exist(const Formula& f) {
        if (is_placeholder(f)) {
            used_.insert("{" + f->name + "}");
            return true;
        }
        if (f->kind == Kind::name) {
            if (std::find(names_.begin(), names_.end(), f->name) != names_.end()) {
                used_.insert(f->name);
                return true;
            }
            if (placeholders_.count(f->name) > 0) complain_at(f->offset, quoted(f->name) + " stands without braces", "write {" + f->name + "}");
            else complain_at(f->offset, "unknown name " + quoted(f->name), did_you_mean(f->name, names_) + "declare it under [[parameter]] or [[scan]], or write a {role}");
            return false;
        }
        if (formula::is_derivative(f) && !sound_derivative(f)) return false;
        bool good = true;
        for (const Formula& a : f->arguments) good = names_exist(a) && good;
        return good;
    }

    bool sound_derivative(const Formula& f) {
        if (!is_placeholder(f->arguments[0])) {
            complain_at(f->arguments[0]->start, "der() of something that is not a role", "write der({speed}) of a role that stands for a signal");
            return false;
        }
        if (f->arguments.size() < 2) return true;
        const Formula& order = f->arguments[1];
        if (order->kind == Kind::number && exact::is_integer(order->value) && order->value >= 1 && order->value <= model::largest_order) return true;
        complain_at(order->start, "the order of der() is not a whole number from 1 to " + std::to_string(model::largest_order), "write der({angle},2)");
        return false;
    }

    /// A model of one equation,  equation = term,  with a signal for each placeholder.
    model::Model probe_of(const Formula& term) const {
        model::Model out;
        out.path = file_.path();
        const auto add_signal = [&](const std::string& name) {
            model::Signal s;
            s.name = name;
            out.signals.push_back(s);
        };
        add_signal(other_side);
        for (const auto& [name, units] : placeholders_) add_signal(name);
        for (const EffectScan& s : effect_.scans) out.constants.push_back({s.name, {}, "", exact::from_double(s.to != 0 ? s.to : s.from)});
        for (const EffectParameter& p : effect_.parameters) out.parameters.push_back({p.name, {}, "", {}, {}, {}});
        model::Equation e;
        e.file = file_.path();
        e.at = at_;
        e.ode = text_;
        e.places = places_;
        e.sides = {std::make_shared<const formula::Node>(formula::Node{Kind::name, 0, 0, 0, other_side, {}}), term};
        out.equations.push_back(std::move(e));
        return out;
    }

    bool is_linear(const model::Model& probe) {
        Diagnostics said;
        const auto form = equation::operator_form(probe, probe.equations[0], said);
        if (!form) {
            const Diagnostic first = said.sorted().front();
            const bool nonlinear = first.what.find("not linear") != std::string::npos;
            file_.error(first.at, first.what, nonlinear ? "make it a factor of the term, or scan it under [[scan]]" : first.right);
            return false;
        }
        bool empty = true;
        for (const equation::Term& t : form->terms) {
            const bool other = t.product.size() == 1 && form->text(t.product) == other_side;
            empty = empty && other;
            for (const auto& [exponents, coefficient] : t.coefficient) {
                int degree = 0;
                for (const int e : exponents) degree += e;
                if (degree == (other ? 0 : 1)) continue;
                if (degree == 0) file_.error(at_, "a part of the term has no parameter: " + quoted(form->text(t.product)), "multiply it by one: what is known is nothing to look for");
                else file_.error(at_, "the term is not linear in its parameters", "name a product or quotient of parameters as one parameter");
                return false;
            }
        }
        if (empty) file_.error(at_, "the term is zero", "write what the effect adds to an equation");
        return !empty;
    }

    /// Complains where the unit of the term is not `unit`, whatever stands for the placeholders.
    bool check_unit(model::Model& probe, const std::string& unit) {
        std::vector<std::pair<std::string, std::vector<std::string>>> open;
        for (const auto& [name, units] : placeholders_) open.emplace_back(name, units.empty() ? std::vector<std::string>{""} : units);
        std::vector<std::size_t> choice(open.size(), 0);
        std::optional<Diagnostic> first;
        for (;;) {
            std::map<std::string, std::string> known = {{"equation", unit}};
            probe.signals[0].unit = unit;
            for (std::size_t k = 0; k < open.size(); ++k) {
                const std::string& text = open[k].second[choice[k]];
                probe.signals[k + 1].unit = text;
                if (!text.empty()) known[open[k].first] = text;
            }
            for (std::size_t k = 0; k < effect_.parameters.size(); ++k) {
                const std::string text = filled(effect_.parameters[k].unit, known);
                probe.parameters[k].unit = text.find('{') == std::string::npos ? text : "";
            }
            for (std::size_t k = 0; k < effect_.scans.size(); ++k) {
                const std::string text = filled(effect_.scans[k].unit, known);
                probe.constants[k].unit = text.find('{') == std::string::npos ? text : "";
            }
            Diagnostics said;
            model::check_dimension(probe, probe.equations[0], said);
            if (!said.has_errors()) return true;
            if (!first) first = said.sorted().front();
            std::size_t k = 0;
            while (k < open.size() && ++choice[k] == open[k].second.size()) choice[k++] = 0;
            if (k == open.size()) break;
        }
        file_.error(first->at, "in an equation in " + unit + ": " + first->what, "check the units of the parameters");
        return false;
    }

    const Effect& effect_;
    const std::string& text_;
    const Placeholders& placeholders_;
    Position at_;
    std::vector<Position> places_;
    model::TomlAccess& file_;
    std::set<std::string>& used_;
    std::vector<std::string> names_;
};

}  // namespace

Placeholders placeholders_of(const Effect& effect) {
    Placeholders out;
    for (const auto& [role, kind] : effect.roles) {
        const auto& kinds = role_kinds();
        const auto found = std::find_if(kinds.begin(), kinds.end(), [&, &wanted = kind](const RoleKind& k) { return k.name == wanted; });
        out[role] = found == kinds.end() ? std::vector<std::string>() : found->units;
    }
    return out;
}

Placeholders axes_of_a_frame() { return {{"d", {"A"}}, {"q", {"A"}}, {"angle", {"rad"}}}; }

void check_term(const Effect& effect, const std::string& text, const Placeholders& placeholders, const toml::node& node, model::TomlAccess& file, std::set<std::string>& used) {
    TermCheck(effect, text, placeholders, node, file, used).run();
}

}  // namespace algest::lab
