// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/transfer.hpp"

#include <cctype>
#include <map>
#include <optional>
#include <set>

#include "generator/model.hpp"
#include "generator/names.hpp"
#include "generator/suggestion.hpp"

namespace algest::model {

namespace {

/// A coefficient of the written-out sum: the name of an unknown, or a known value.
struct Coefficient {
    std::string unknown;   ///< empty: known
    exact::Rational value;
    Position at;
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

bool is_one(const std::string& unit) { return unit.empty() || unit == "1" || unit == "-"; }

/// "rad/(V.s^2)": unit of y over (unit of x times s^power).
std::string quotient_unit(const std::string& y, const std::string& x, int power) {
    std::string below = is_one(x) ? "" : x;
    if (power != 0) below += (below.empty() ? "" : ".") + std::string("s") + (power == 1 ? "" : "^" + std::to_string(power));
    const std::string above = is_one(y) ? "1" : y.find('/') == std::string::npos ? y : "(" + y + ")";
    if (below.empty()) return above;
    const bool plain = below.find_first_of("./") == std::string::npos;
    return above + "/" + (plain ? below : "(" + below + ")");
}

class Writer {
public:
    Writer(const Transfer& transfer, Model& model, Equation& equation, Diagnostics& diagnostics)
        : transfer_(transfer), model_(model), equation_(equation), diagnostics_(diagnostics) {}

    bool write() {
        if (!signals_exist()) return false;
        inputs_.resize(transfer_.inputs.size());
        place(transfer_.coefficients, -1);
        for (std::size_t i = 0; i < transfer_.inputs.size(); ++i) place(transfer_.inputs[i].coefficients, static_cast<int>(i));
        if (failed_) return false;
        output_.try_emplace(transfer_.n, Coefficient{"", 1, transfer_.at});
        complete(output_, "a", transfer_.n, transfer_.at);
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            complete(inputs_[i], transfer_.inputs.size() > 1 ? "its b" : "b", transfer_.inputs[i].m, transfer_.inputs[i].m_at);
        }
        const Coefficient& leading = output_.at(transfer_.n);
        if (leading.unknown.empty() && cln::zerop(leading.value)) {
            fail(leading.at, "the coefficient of the highest derivative is 0", "lower n, or leave a" + std::to_string(transfer_.n) + " out: it is 1");
        }
        if (failed_) return false;
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
    void fail(Position at, const std::string& what, const std::string& right) {
        diagnostics_.error(model_.path, at, what, right);
        failed_ = true;
    }

    bool signals_exist() {
        std::set<std::string> seen = {transfer_.output};
        if (model_.signal(transfer_.output) == nullptr) fail(transfer_.output_at, quoted(transfer_.output) + " is not a signal", did_you_mean(transfer_.output, signal_names(model_)) + "declare it under [signals], or name the output");
        for (const TransferInput& input : transfer_.inputs) {
            if (model_.signal(input.signal) == nullptr) fail(input.at, quoted(input.signal) + " is not a signal", did_you_mean(input.signal, signal_names(model_)) + "declare it under [signals], or name the input");
            else if (!seen.insert(input.signal).second) fail(input.at, quoted(input.signal) + " stands twice in the equation", "name it once, as output or as input");
        }
        return !failed_;
    }

    /// Puts coefficients in their sums. input -1: the lists of [transfer] itself.
    void place(const Coefficients& list, int input) {
        for (const UnknownCoefficient& u : list.unknowns) {
            if (const auto fault = fault_of_name(u.name)) fail(u.at, fault->what, fault->right);
            else if (!unknowns_.insert(u.name).second) named_twice(u.name, u.at);
            else if (!is_free(u.name)) fail(u.at, "'" + u.name + "' is a signal, a constant or another unknown as well, or differs by case alone", "rename one of them");
            else place(u.name, Coefficient{u.name, 0, u.at}, input);
        }
        for (const KnownCoefficient& k : list.known) place(k.name, Coefficient{"", k.value, k.at}, input);
    }

    void place(const std::string& name, const Coefficient& coefficient, int input) {
        const Position at = coefficient.at;
        const auto split = indexed(name);
        if (!split) return fail(at, quoted(name) + " does not end in the order of a derivative", "write e.g. a0, a1, b0");
        const bool several = transfer_.inputs.size() > 1;
        const bool of_output = input < 0 && split->letters == "a";
        if (input < 0 && several && !of_output) return fail(at, quoted(name) + " beside [[transfer.input]]", "list it with its input");
        const std::size_t which = input < 0 ? 0 : static_cast<std::size_t>(input);
        const int most = of_output ? transfer_.n : transfer_.inputs[which].m;
        if (split->order > most) {
            return fail(at, quoted(name) + " belongs to a derivative of order " + std::to_string(split->order) + ", above " + (of_output ? "n = " : "m = ") + std::to_string(most),
                        "raise the order, or remove it");
        }
        std::map<int, Coefficient>& sum = of_output ? output_ : inputs_[which];
        if (!sum.try_emplace(split->order, coefficient).second) named_twice(name, at);
    }

    void named_twice(const std::string& name, Position at) {
        fail(at, quoted(name) + " is named twice", "list each coefficient once, as unknown or as known");
    }

    /// No signal, constant, other parameter or earlier unknown has the name, or one that differs by case alone. A parameter
    /// of exactly this name is the same: [parameters] gives it a unit and an initial value.
    bool is_free(const std::string& name) const {
        std::set<std::string> others;
        for (const Signal& s : model_.signals) others.insert(folded(s.name));
        for (const Constant& c : model_.constants) others.insert(folded(c.name));
        for (const Parameter& p : model_.parameters) if (p.name != name) others.insert(folded(p.name));
        for (const std::string& u : unknowns_) if (u != name) others.insert(folded(u));
        return others.count(folded(name)) == 0;
    }

    /// Every coefficient up to `most` must have been named.
    void complete(const std::map<int, Coefficient>& sum, const std::string& letter, int most, Position at) {
        for (int i = 0; i <= most; ++i) {
            if (sum.count(i) > 0) continue;
            const std::string name = letter + std::to_string(i);
            fail(at, "coefficient " + name + " is neither unknown nor known", "list it under unknowns, or write known = { " + (letter == "its b" ? "b" + std::to_string(i) : name) + " = 0 }");
        }
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
                p.at = c.at;
                const std::string unit = model_.signal(signal)->unit;
                const bool own = signal == transfer_.output;
                if (monic && (own || (!unit.empty() && !output_unit.empty()))) {
                    p.unit = own ? quotient_unit("", "", transfer_.n - order) : quotient_unit(output_unit, unit, transfer_.n - order);
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
    std::set<std::string> unknowns_;
    bool failed_ = false;
};

}  // namespace

bool write_out(const Transfer& transfer, Model& model, Equation& equation, Diagnostics& diagnostics) {
    return Writer(transfer, model, equation, diagnostics).write();
}

}  // namespace algest::model
