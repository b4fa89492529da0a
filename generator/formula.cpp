// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/formula.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "generator/suggestion.hpp"

namespace algest::formula {

namespace {

constexpr std::array<std::string_view, 10> functions = {"sin", "cos", "tan", "exp", "log", "sqrt", "abs", "sgn", "min", "max"};

struct Stop {};   // unwinds the parser after its one complaint

class Parser {
public:
    Parser(std::string_view text, const Complain& complain, bool equation) : text_(text), complain_(complain), equation_(equation) {}

    Formula expression() { return sum(0); }

    void expect_end() {
        blanks();
        if (at_ < text_.size()) not_an_operator();
    }

    /// Moves behind the '=' of the equation.
    void expect_equals() {
        if (!accept('=')) {
            if (at_ < text_.size()) not_an_operator();
            fail(offset(), "an equation without '='", "write left = right");
        }
        behind_equals_ = true;
    }

    [[noreturn]] void fail(int offset, const std::string& what, const std::string& right) const {
        complain_(offset, what, right);
        throw Stop{};
    }

    void check_length() const {
        if (text_.size() > static_cast<std::size_t>(longest_text)) {
            fail(0, "the formula has " + std::to_string(text_.size()) + " characters, more than " + std::to_string(longest_text),
                 "split the equation, or name its parts as signals");
        }
    }

private:
    static bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
    static bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    void blanks() {
        while (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r') ++at_;
    }

    bool accept(char c) {
        blanks();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    int offset() {
        blanks();
        return static_cast<int>(at_);
    }

    /// What stands here can stand nowhere, or not before and not behind an operand.
    [[noreturn]] void unexpected() const {
        const int here = static_cast<int>(at_);
        if (text_.substr(at_, 2) == "**") fail(here, "'**' is not an operator", "write ^ for a power");
        if (peek() == '=' && !equation_) fail(here, "'=' in an expression", "write the right side alone");
        if (peek() == '=' && behind_equals_) fail(here, "a second '='", "an equation has one '='");
        const unsigned char byte = static_cast<unsigned char>(peek());
        const std::string shown = byte < 0x20 || byte >= 0x7F ? std::string("a character that no formula has") : std::string("unexpected '") + peek() + "'";
        fail(here, shown, "formulas have numbers, names, + - * / ^ ( ) , and functions");
    }

    /// Stopped where an operand should stand.
    [[noreturn]] void not_an_operand() const {
        const int here = static_cast<int>(at_);
        if (at_ >= text_.size()) fail(here, "the formula ends too early", "add the missing operand or ')'");
        const char c = peek();
        const bool second_equals = c == '=' && (behind_equals_ || !equation_);
        const bool twice = text_.substr(at_, 2) == "**";
        if (!second_equals && !twice && std::string_view("*/^),=").find(c) != std::string_view::npos) {
            fail(here, std::string("an operand is missing before '") + c + "'", "add it, or remove the '" + std::string(1, c) + "'");
        }
        unexpected();
    }

    /// Stopped behind an operand, where an operator could stand or the formula end.
    [[noreturn]] void not_an_operator() const {
        const int here = static_cast<int>(at_);
        const char c = peek();
        if (c == ')') fail(here, "')' without '('", "remove it, or open it before");
        if (is_digit(c) || is_letter(c) || c == '(') {
            fail(here, std::string("an operator is missing before '") + c + "'", "write * for a product");
        }
        unexpected();
    }

    Formula node(Kind kind, int offset, int start, std::vector<Formula> arguments, std::string name = {}, exact::Rational value = 0) {
        if (++tokens_ > most_tokens) {
            fail(offset, "the formula has more than " + std::to_string(most_tokens) + " operations", "split the equation");
        }
        return std::make_shared<const Node>(Node{kind, offset, start, std::move(value), std::move(name), std::move(arguments)});
    }

    Formula binary(Kind kind, int offset, const Formula& left, const Formula& right) { return node(kind, offset, left->start, {left, right}); }

    void check_depth(int depth) {
        if (depth > deepest_nesting) {
            fail(offset(), "nested deeper than " + std::to_string(deepest_nesting) + " levels", "write it flatter");
        }
    }

    Formula sum(int depth) {
        check_depth(depth);
        Formula left = product(depth);
        for (;;) {
            const int here = offset();
            if (accept('+')) left = binary(Kind::add, here, left, product(depth));
            else if (accept('-')) left = binary(Kind::subtract, here, left, product(depth));
            else return left;
        }
    }

    Formula product(int depth) {
        Formula left = unary(depth);
        for (;;) {
            const int here = offset();
            if (text_.substr(at_, 2) == "**") unexpected();
            if (accept('*')) left = binary(Kind::multiply, here, left, unary(depth));
            else if (accept('/')) left = binary(Kind::divide, here, left, unary(depth));
            else return left;
        }
    }

    Formula unary(int depth) {
        check_depth(depth);
        const int here = offset();
        if (accept('-')) return node(Kind::negate, here, here, {unary(depth + 1)});
        if (accept('+')) return unary(depth + 1);
        return power(depth);
    }

    Formula power(int depth) {
        Formula base = primary(depth);
        const int here = offset();
        if (!accept('^')) return base;
        return binary(Kind::power, here, base, unary(depth + 1));   // right-associative
    }

    Formula primary(int depth) {
        const int here = offset();
        if (accept('(')) {
            const Formula inside = sum(depth + 1);
            if (!accept(')')) {
                if (at_ >= text_.size()) fail(here, "'(' is never closed", "add ')'");
                not_an_operator();
            }
            Node with_parentheses = *inside;
            with_parentheses.start = here;
            return std::make_shared<const Node>(std::move(with_parentheses));
        }
        if (is_digit(peek()) || peek() == '.') return number();
        if (is_letter(peek())) return name_or_call(depth);
        not_an_operand();
    }

    Formula number() {
        const std::size_t start = at_;
        const auto digits = [&] { while (is_digit(peek())) ++at_; };
        digits();
        if (peek() == '.') { ++at_; digits(); }
        if (peek() == 'e' || peek() == 'E') {
            std::size_t next = at_ + 1;
            if (next < text_.size() && (text_[next] == '+' || text_[next] == '-')) ++next;
            if (next < text_.size() && is_digit(text_[next])) { at_ = next; digits(); }
        }
        const auto value = exact::parse(text_.substr(start, at_ - start));
        if (!value) {
            fail(static_cast<int>(start), "not a number that can be read exactly",
                 "write one with an exponent within +-400, and as a fraction of whole numbers with at most 400 digits each");
        }
        if (is_letter(peek())) fail(static_cast<int>(at_), "a name right after a number", "write * between them");
        return node(Kind::number, static_cast<int>(start), static_cast<int>(start), {}, {}, *value);
    }

    Formula name_or_call(int depth) {
        const int here = static_cast<int>(at_);
        while (is_letter(peek()) || is_digit(peek())) ++at_;
        std::string name(text_.substr(static_cast<std::size_t>(here), at_ - static_cast<std::size_t>(here)));
        if (name.size() > static_cast<std::size_t>(longest_name)) {
            fail(here, "a name of " + std::to_string(name.size()) + " characters", "names have at most " + std::to_string(longest_name));
        }
        if (!accept('(')) return node(Kind::name, here, here, {}, std::move(name));
        if (name != "der" && name != "delay" && !is_function(name)) {
            std::vector<std::string> known = {"der", "delay"};
            known.insert(known.end(), functions.begin(), functions.end());
            fail(here, "'" + name + "' is not a function",
                 did_you_mean(name, known) + "functions are der delay sin cos tan exp log sqrt abs sgn min max; write * for a product");
        }
        std::vector<Formula> arguments;
        if (!accept(')')) {
            do arguments.push_back(sum(depth + 1));
            while (accept(','));
            if (!accept(')')) {
                if (at_ >= text_.size()) fail(here, "'(' of " + name + " is never closed", "add ')'");
                not_an_operator();
            }
        }
        check_count(name, here, arguments.size());
        return node(Kind::call, here, here, std::move(arguments), std::move(name));
    }

    void check_count(const std::string& name, int here, std::size_t arguments) {
        if (name == "der") {
            if (arguments < 1 || arguments > 2) fail(here, "der takes a signal and, if wanted, an order", "der(x) or der(x,2)");
        } else if (name == "delay") {
            if (arguments != 2) fail(here, "delay takes a signal and a time in seconds", "delay(x,0.02)");
        } else if (is_function_of_two(name)) {
            if (arguments != 2) fail(here, name + " takes two arguments", name + "(x,y)");
        } else if (arguments != 1) {
            fail(here, name + " takes one argument", name + "(x)");
        }
    }

    std::string_view text_;
    const Complain& complain_;
    bool equation_;
    bool behind_equals_ = false;
    std::size_t at_ = 0;
    int tokens_ = 0;
};

int precedence(Kind kind) {
    switch (kind) {
        case Kind::add:
        case Kind::subtract: return 1;
        case Kind::multiply:
        case Kind::divide: return 2;
        case Kind::negate: return 3;
        case Kind::power: return 4;
        default: return 5;
    }
}

std::string number_text(const exact::Rational& value) {
    const std::string plain = exact::text(value);
    return plain.find('/') == std::string::npos ? plain : "(" + plain + ")";
}

std::string printed(const Formula& f, int outer) {
    const int own = precedence(f->kind);
    std::string out;
    switch (f->kind) {
        case Kind::number: return number_text(f->value);
        case Kind::name: return f->name;
        case Kind::call: {
            out = f->name + "(";
            for (std::size_t i = 0; i < f->arguments.size(); ++i) out += (i > 0 ? "," : "") + printed(f->arguments[i], 0);
            return out + ")";
        }
        case Kind::negate: out = "-" + printed(f->arguments[0], own); break;
        case Kind::add: out = printed(f->arguments[0], own) + " + " + printed(f->arguments[1], own + 1); break;
        case Kind::subtract: out = printed(f->arguments[0], own) + " - " + printed(f->arguments[1], own + 1); break;
        case Kind::multiply: out = printed(f->arguments[0], own) + "*" + printed(f->arguments[1], own + 1); break;
        case Kind::divide: out = printed(f->arguments[0], own) + "/" + printed(f->arguments[1], own + 1); break;
        case Kind::power: out = printed(f->arguments[0], own + 1) + "^" + printed(f->arguments[1], own); break;   // right-associative
    }
    return own < outer ? "(" + out + ")" : out;
}

std::string latex_printed(const Formula& f, int outer) {
    const int own = precedence(f->kind);
    std::string out;
    switch (f->kind) {
        case Kind::number: return exact::latex(f->value);
        case Kind::name: return latex_name(f->name);
        case Kind::call: {
            if (f->name == "der") {
                const std::string order = f->arguments.size() > 1 ? printed(f->arguments[1], 0) : "1";
                return latex_printed(f->arguments[0], 5) + (order == "1" ? "'" : "^{(" + order + ")}");
            }
            if (f->name == "delay") return latex_printed(f->arguments[0], 5) + "\\left(t-" + latex_printed(f->arguments[1], 2) + "\\right)";
            if (f->name == "sqrt") return "\\sqrt{" + latex_printed(f->arguments[0], 0) + "}";
            if (f->name == "abs") return "\\left|" + latex_printed(f->arguments[0], 0) + "\\right|";
            out = (f->name == "sgn" ? "\\operatorname{sgn}" : "\\" + f->name) + "\\left(";
            for (std::size_t i = 0; i < f->arguments.size(); ++i) out += (i > 0 ? "," : "") + latex_printed(f->arguments[i], 0);
            return out + "\\right)";
        }
        case Kind::negate: out = "-" + latex_printed(f->arguments[0], own); break;
        case Kind::add: out = latex_printed(f->arguments[0], own) + " + " + latex_printed(f->arguments[1], own + 1); break;
        case Kind::subtract: out = latex_printed(f->arguments[0], own) + " - " + latex_printed(f->arguments[1], own + 1); break;
        case Kind::multiply: out = latex_printed(f->arguments[0], own) + "\\," + latex_printed(f->arguments[1], own + 1); break;
        case Kind::divide: return "\\frac{" + latex_printed(f->arguments[0], 0) + "}{" + latex_printed(f->arguments[1], 0) + "}";
        case Kind::power: return "{" + latex_printed(f->arguments[0], own + 1) + "}^{" + latex_printed(f->arguments[1], 0) + "}";
    }
    return own < outer ? "\\left(" + out + "\\right)" : out;
}

}  // namespace

bool is_function_of_two(std::string_view name) { return name == "min" || name == "max"; }

bool is_call(const Formula& f, std::string_view name) { return f->kind == Kind::call && f->name == name; }
bool is_derivative(const Formula& f) { return is_call(f, "der"); }
int derivative_order(const Formula& der) { return der->arguments.size() > 1 ? cln::cl_I_to_int(cln::numerator(der->arguments[1]->value)) : 1; }

bool is_function(std::string_view name) { return std::find(functions.begin(), functions.end(), name) != functions.end(); }

std::optional<Formula> parse(std::string_view text, const Complain& complain) {
    try {
        Parser parser(text, complain, false);
        parser.check_length();
        Formula out = parser.expression();
        parser.expect_end();
        return out;
    } catch (const Stop&) {
        return std::nullopt;
    }
}

std::optional<Equation> parse_equation(std::string_view text, const Complain& complain) {
    try {
        Parser parser(text, complain, true);
        parser.check_length();
        Equation out;
        out.left = parser.expression();
        parser.expect_equals();
        out.right = parser.expression();
        parser.expect_end();
        return out;
    } catch (const Stop&) {
        return std::nullopt;
    }
}

std::string text(const Formula& formula) { return printed(formula, 0); }
std::string latex(const Formula& formula) { return latex_printed(formula, 0); }

std::string latex_name(const std::string& name) {
    static constexpr std::array<std::string_view, 24> greek = {
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "kappa", "lambda", "mu", "nu",
        "xi", "pi", "rho", "sigma", "tau", "phi", "chi", "psi", "omega", "Gamma", "Delta", "Omega"};
    std::string stem = name;
    std::string subscript;
    const std::size_t underscore = name.find('_');
    if (underscore != std::string::npos) {
        stem = name.substr(0, underscore);
        subscript = name.substr(underscore + 1);
    } else {
        std::size_t digits = name.size();
        while (digits > 1 && std::isdigit(static_cast<unsigned char>(name[digits - 1])) != 0) --digits;
        stem = name.substr(0, digits);
        subscript = name.substr(digits);
    }
    std::string escaped;
    for (const char c : subscript) escaped += c == '_' ? std::string("\\_") : std::string(1, c);
    bool is_greek = false;
    for (const std::string_view g : greek) is_greek = is_greek || g == stem;
    std::string out = is_greek ? "\\" + stem : stem.size() > 1 ? "\\mathrm{" + stem + "}" : stem;
    if (!escaped.empty()) out += "_{" + (escaped.size() > 1 ? "\\mathrm{" + escaped + "}" : escaped) + "}";
    return out;
}

}  // namespace algest::formula
