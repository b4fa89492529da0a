// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/transfer.hpp"

#include <cctype>
#include <map>
#include <optional>
#include <set>

#include "generator/model.hpp"
#include "generator/names.hpp"

namespace algest::model {

namespace {

/// A coefficient of the written-out sum: the name of an unknown, or a known value.
struct Coefficient {
    std::string unknown;   ///< empty: known
    exact::Rational value = 0;
};

/// Splits "b12" into its letters and 12; nullopt without digits at the end.
struct IndexedName {
    std::string letters;
    int order;
};
std::optional<IndexedName> indexed(const std::string& name) {
    std::size_t digits = name.size();
    while (digits > 0 && std::isdigit(static_cast<unsigned char>(name[digits - 1])) != 0) --digits;
    if (digits == 0 || digits == name.size() || name.size() - digits > 2) return std::nullopt;
    return IndexedName{name.substr(0, digits), std::stoi(name.substr(digits))};
}

std::string derivative_text(const std::string& signal, int order) {
    if (order == 0) return signal;
    return order == 1 ? "der(" + signal + ")" : "der(" + signal + "," + std::to_string(order) + ")";
}

std::string product_text(const Coefficient& c, const std::string& operand) {
    if (!c.unknown.empty()) return c.unknown + "*" + operand;
    if (c.value == 1) return operand;
    const std::string number = exact::text(c.value);
    return (number.find_first_of("-/") == std::string::npos ? number : "(" + number + ")") + "*" + operand;
}

std::string sum_text(const std::map<int, Coefficient>& coefficients, const std::string& signal) {
    std::string out;
    for (auto it = coefficients.rbegin(); it != coefficients.rend(); ++it) {
        if (it->second.unknown.empty() && cln::zerop(it->second.value)) continue;
        out += (out.empty() ? "" : " + ") + product_text(it->second, derivative_text(signal, it->first));
    }
    return out;
}

/// "rad/(V.s^2)": unit of y over (unit of x times s^power).
std::string quotient_unit(const std::string& y, const std::string& x, int power) {
    std::string below = x;
    if (power != 0) below += (below.empty() ? "" : ".") + std::string("s") + (power == 1 ? "" : "^" + std::to_string(power));
    const std::string above = y.empty() ? "1" : y.find('/') == std::string::npos ? y : "(" + y + ")";
    if (below.empty()) return above;
    const bool plain = below.find_first_of("./") == std::string::npos;
    return above + "/" + (plain ? below : "(" + below + ")");
}

class Writer {
public:
    Writer(const Transfer& transfer, Model& model, Equation& equation, Diagnostics& diagnostics)
        : transfer_(transfer), model_(model), equation_(equation), diagnostics_(diagnostics) {}

    bool write() {
        if (model_.signal(transfer_.output) == nullptr) return fail(transfer_.output_at, "'" + transfer_.output + "' is not a signal", "declare it under [signals], or name the output");
        const bool several = transfer_.inputs.size() > 1;
        for (const TransferInput& input : transfer_.inputs) {
            if (model_.signal(input.signal) == nullptr) return fail(input.at, "'" + input.signal + "' is not a signal", "declare it under [signals], or name the input");
        }
        inputs_.resize(transfer_.inputs.size());
        for (const UnknownCoefficient& u : transfer_.coefficients.unknowns) if (!place(u.name, u.at, Coefficient{u.name, 0}, -1)) return false;
        for (const KnownCoefficient& k : transfer_.coefficients.known) if (!place(k.name, k.at, Coefficient{"", k.value}, -1)) return false;
        for (std::size_t i = 0; i < transfer_.inputs.size(); ++i) {
            for (const UnknownCoefficient& u : transfer_.inputs[i].coefficients.unknowns) if (!place(u.name, u.at, Coefficient{u.name, 0}, static_cast<int>(i))) return false;
            for (const KnownCoefficient& k : transfer_.inputs[i].coefficients.known) if (!place(k.name, k.at, Coefficient{"", k.value}, static_cast<int>(i))) return false;
        }
        output_.try_emplace(transfer_.n, Coefficient{"", 1});
        if (!complete(output_, "a", transfer_.n, transfer_.at)) return false;
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            if (!complete(inputs_[i], several ? "its b" : "b", transfer_.inputs[i].m, transfer_.inputs[i].m_at)) return false;
        }
        const Coefficient& leading = output_.at(transfer_.n);
        if (leading.unknown.empty() && cln::zerop(leading.value)) {
            return fail(transfer_.at, "the coefficient of the highest derivative is 0", "lower n, or leave a" + std::to_string(transfer_.n) + " out: it is 1");
        }
        add_parameters();
        equation_.ode = sum_text(output_, transfer_.output) + " = ";
        std::string right;
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            const std::string sum = sum_text(inputs_[i], transfer_.inputs[i].signal);
            if (!sum.empty()) right += (right.empty() ? "" : " + ") + sum;
        }
        equation_.ode += right.empty() ? "0" : right;
        const auto sides = formula::parse_equation(equation_.ode, [&](int, const std::string& what, const std::string& better) {
            fail(transfer_.at, what, better);
        });
        if (!sides) return false;
        equation_.sides = *sides;
        return true;
    }

private:
    bool fail(Position at, const std::string& what, const std::string& right) {
        diagnostics_.error(model_.path, at, what, right);
        return false;
    }

    /// Puts one coefficient in its sum. input -1: the list of [transfer] itself.
    bool place(const std::string& name, Position at, const Coefficient& coefficient, int input) {
        const auto split = indexed(name);
        const bool several = transfer_.inputs.size() > 1 || input >= 0;
        if (!split) return fail(at, "'" + name + "' does not end in the order of a derivative", "write e.g. a0, a1, b0");
        if (!coefficient.unknown.empty()) {
            if (const auto fault = fault_of_name(name)) return fail(at, fault->what, fault->right);
        }
        const bool of_output = input < 0 && (split->letters == "a" || several);
        if (input < 0 && several && split->letters != "a") return fail(at, "'" + name + "' beside [[transfer.input]]", "list it with its input");
        const std::size_t which = input < 0 ? 0 : static_cast<std::size_t>(input);
        const int most = of_output ? transfer_.n : transfer_.inputs[which].m;
        if (split->order > most) {
            return fail(at, "'" + name + "' belongs to a derivative of order " + std::to_string(split->order) + ", above " + (of_output ? "n = " : "m = ") + std::to_string(most),
                        "raise the order, or remove it");
        }
        std::map<int, Coefficient>& sum = of_output ? output_ : inputs_[which];
        if (!names_.insert(name).second || !sum.try_emplace(split->order, coefficient).second) {
            return fail(at, "'" + name + "' is named twice", "list each coefficient once, as unknown or as known");
        }
        const bool clash = model_.signal(name) != nullptr || model_.constant(name) != nullptr;
        if (!coefficient.unknown.empty() && clash) return fail(at, "'" + name + "' is a signal or a constant as well", "rename one of them");
        return true;
    }

    /// Every coefficient up to `most` must have been named.
    bool complete(const std::map<int, Coefficient>& sum, const std::string& letter, int most, Position at) {
        for (int i = 0; i <= most; ++i) {
            if (sum.count(i) == 0) {
                const std::string name = letter + std::to_string(i);
                return fail(at, "coefficient " + name + " is neither unknown nor known", "list it under unknowns, or write known = { " + (letter == "its b" ? "b" + std::to_string(i) : name) + " = 0 }");
            }
        }
        return true;
    }

    void add_parameters() {
        const Coefficient& leading = output_.at(transfer_.n);
        const bool monic = leading.unknown.empty() && leading.value == 1;
        const std::string output_unit = model_.signal(transfer_.output)->unit;
        const auto add = [&](const std::map<int, Coefficient>& sum, const std::string& signal) {
            for (const auto& [order, c] : sum) {
                if (c.unknown.empty() || model_.parameter(c.unknown) != nullptr) continue;
                Parameter p;
                p.name = c.unknown;
                p.at = transfer_.at;
                const std::string unit = model_.signal(signal)->unit;
                const bool own = signal == transfer_.output;
                if (monic && (own || (!unit.empty() && !output_unit.empty()))) {
                    p.unit = own ? quotient_unit("", "", transfer_.n - order) : quotient_unit(output_unit, unit == "1" ? "" : unit, transfer_.n - order);
                }
                model_.parameters.push_back(p);
            }
        };
        add(output_, transfer_.output);
        for (std::size_t i = 0; i < inputs_.size(); ++i) add(inputs_[i], transfer_.inputs[i].signal);
    }

    const Transfer& transfer_;
    Model& model_;
    Equation& equation_;
    Diagnostics& diagnostics_;
    std::map<int, Coefficient> output_;
    std::vector<std::map<int, Coefficient>> inputs_;
    std::set<std::string> names_;
};

}  // namespace

bool write_out(const Transfer& transfer, Model& model, Equation& equation, Diagnostics& diagnostics) {
    return Writer(transfer, model, equation, diagnostics).write();
}

}  // namespace algest::model
