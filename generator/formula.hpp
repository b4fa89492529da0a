// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas as a person writes them: text -> tree, with the column of every token, exact decimals and limits on size.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "generator/exact.hpp"

namespace algest::formula {

enum class Kind { number, name, negate, add, subtract, multiply, divide, power, call };

struct Node;
using Formula = std::shared_ptr<const Node>;

struct Node {
    Kind kind;
    int offset;                       ///< of the token in the text, in bytes from 0: of an operator, the operator
    int start;                        ///< of the first token, an opening parenthesis included
    exact::Rational value;            ///< of a number
    std::string name;                 ///< of a name or a call
    std::vector<Formula> arguments;   ///< operands in written order
};

/// Both sides of an equation, split at its one '='.
struct Equation {
    Formula left;
    Formula right;
};

/// Called with the offset of what is wrong, what it is, and what would be right.
using Complain = std::function<void(int offset, const std::string& what, const std::string& right)>;

/// Longest text, deepest nesting, most tokens of a formula.
constexpr int longest_text = 20000;
constexpr int deepest_nesting = 100;
constexpr int most_tokens = 4000;
/// Longest name.
constexpr int longest_name = 60;
/// Largest integer exponent.
constexpr int largest_exponent = 32;

/// Functions of one and of two arguments that a formula may call, `der` and `delay` aside: those are of a signal, not of a value.
bool is_function(std::string_view name);
bool is_function_of_two(std::string_view name);

/// True for a call of `name`.
bool is_call(const Formula& f, std::string_view name);
bool is_derivative(const Formula& f);
/// n of der(x, n); 1 of der(x).
int derivative_order(const Formula& der);

/// Parses an expression; one complaint and nullopt if it is none.
std::optional<Formula> parse(std::string_view text, const Complain& complain);
/// Parses `left = right`.
std::optional<Equation> parse_equation(std::string_view text, const Complain& complain);

/// The formula in one canonical spelling: minimal parentheses, one blank around + and -, none around * / ^.
std::string text(const Formula& formula);
/// The same in LaTeX.
std::string latex(const Formula& formula);
/// A name with its subscript in LaTeX: i_d -> i_{d}, Gamma1 -> \Gamma_{1}, lambda1 -> \lambda_{1}.
std::string latex_name(const std::string& name);

}  // namespace algest::formula
