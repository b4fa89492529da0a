// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/elimination_text.hpp"

#include "generator/elimination_data.hpp"
#include "generator/exact.hpp"

namespace algest::generator {

namespace {

/// Of the plan's scalar: f behind a float.
std::string text(double x, const std::string& suffix) { return exact::hexadecimal(x) + suffix; }
std::string text(std::uint16_t x, const std::string&) { return std::to_string(x); }
std::string text(std::uint8_t x, const std::string&) { return std::to_string(x); }
std::string text(const Alone<double>& a, const std::string& suffix) { return "{" + std::to_string(a.parameter) + ", " + std::to_string(a.squared) + ", " + text(a.coefficient, suffix) + "}"; }
std::string text(const EliminationStage& s, const std::string&) {
    std::string out;
    for (const std::uint16_t number : {s.first_column, s.columns, s.first_alone, s.alone, s.first_summand, s.summands, s.x, s.y, s.squares, s.degree_x, s.degree_y, s.first_term, s.terms,
                                       s.first_factor, s.factors, s.resultant_degree, s.degree_of_first}) {
        out += (out.empty() ? "" : ", ") + (number == no_parameter ? std::string("no_parameter") : std::to_string(number));
    }
    return "{" + out + "}";
}

/// An array, or that there is none: C++ has none of length 0.
template <class T>
void set_array(Data& arrays, DataList& list, const std::string& type, const std::string& name, const std::vector<T>& values, const std::string& suffix) {
    constexpr std::size_t a_line = 16;
    Data array;
    std::string lines;
    for (std::size_t k = 0; k < values.size(); ++k) lines += (k % a_line == 0 ? (k == 0 ? "    " : "\n    ") : " ") + text(values[k], suffix) + ",";
    array.set("type", type);
    array.set("array", name);
    array.set("length", std::to_string(values.size()));
    array.set("array_values", lines);
    if (!values.empty()) list.push_back(array);
    arrays.set("view_" + name, values.empty() ? std::string("{nullptr, 0}") : "{" + name + ", " + std::to_string(values.size()) + "}");
}

std::string listed_names(const plan::Plan& plan, const std::vector<int>& parameters) {
    std::string out;
    for (const int p : parameters) out += (out.empty() ? "" : ", ") + plan.parameters[static_cast<std::size_t>(p)].name;
    return out;
}

std::string resultant_text(const plan::Plan& plan, const plan::EliminationStage& s) {
    const auto name = [&](int p, bool squared) { return plan.parameters[static_cast<std::size_t>(p)].name + (squared ? "^2" : ""); };
    if (s.y < 0) return "nothing is left: linear least squares.";
    const std::string y = name(s.y, s.y_squared);
    if (s.x < 0) return "the derivative of the error by " + y + " is a polynomial of degree " + std::to_string(2 * s.degree_y - 1) + "; each of its real roots is a candidate.";
    const std::string x = name(s.x, s.x_squared);
    return "the derivatives of the error by " + x + " and " + y + " have degrees " + std::to_string(s.degree_of_first) + " and " + std::to_string(s.degree_of_second) + " in " + x +
           "; their resultant has " + std::to_string(s.resultant.size()) + " terms and degree " + std::to_string(s.resultant_degree) + " in " + y +
           ". Each of its real roots with each real root of the first derivative is a candidate, and must satisfy both.";
}

}  // namespace

void set_elimination(const plan::Plan& plan, Data& d) {
    const auto data = plan::make_elimination<double>(plan.elimination);
    const bool wide = plan.scalar == plan::Scalar::float64;
    const std::string scalar = wide ? "double" : "float";
    const std::string suffix = wide ? "" : "f";
    DataList arrays;
    set_array(d, arrays, "EliminationStage", "stages", data.stages, suffix);
    set_array(d, arrays, "Alone<" + scalar + ">", "alone", data.alone, suffix);
    set_array(d, arrays, "std::uint16_t", "column_of", data.column_of, suffix);
    set_array(d, arrays, scalar, "coefficient_of", data.coefficient_of, suffix);
    set_array(d, arrays, "std::uint8_t", "exponents", data.exponents, suffix);
    set_array(d, arrays, scalar, "resultant", data.terms, suffix);
    set_array(d, arrays, "std::uint8_t", "factors", data.factors, suffix);
    set_array(d, arrays, scalar, "parameter_sizes", data.sizes, suffix);
    d.set("eliminates", plan.elimination.has_value());
    d.set("elimination_macs", std::to_string(wide ? elimination_cost(data.view(), plan.points_above_noise()) : elimination_cost(plan::make_elimination<float>(plan.elimination).view(), plan.points_above_noise())));
    d.set("elimination_stack", std::to_string(elimination_scratch(data.view(), plan.points_above_noise()) * (wide ? 8 : 4)));
    d.set("eliminated_parameters", std::to_string(data.parameters));
    d.set("elimination_arrays", listed(arrays));
}

std::vector<std::string> elimination_stages(const plan::Plan& plan) {
    std::vector<std::string> out;
    if (!plan.elimination) return out;
    for (const plan::EliminationStage& s : plan.elimination->stages) {
        std::string equations;
        for (const std::string& e : s.equations) equations += (equations.empty() ? "" : ", ") + e;
        std::vector<int> alone;
        for (const plan::EliminationAlone& a : s.alone) alone.push_back(a.parameter);
        std::string columns;
        for (int c = s.first_column; c < s.first_column + s.columns; ++c) columns += (c == s.first_column ? "" : ", ") + plan.lumped[static_cast<std::size_t>(c)].meaning;
        out.push_back("Equation " + equations + ": columns " + columns + ". " + (alone.empty() ? std::string() : "Linear and eliminated first: " + listed_names(plan, alone) + "; ") +
                      resultant_text(plan, s));
    }
    return out;
}

}  // namespace algest::generator
