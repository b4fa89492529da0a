// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/tidy_unit.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "generator/units.hpp"

namespace algest::units {

namespace {

constexpr int largest_power = 32;
constexpr int deepest_nesting = 32;

/// Names with their exponents, in the order in which they were met.
using Product = std::vector<std::pair<std::string, int>>;

class Parser {
public:
    explicit Parser(const std::string& text) : text_(text) {}

    std::optional<Product> whole() {
        Product out;
        if (!product(out, 1) || at_ != text_.size()) return std::nullopt;
        return out;
    }

private:
    bool take(char c) {
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    /// Factors joined by . * and /, all to the power `sign`.
    bool product(Product& out, int sign) {
        if (++depth_ > deepest_nesting) return false;
        int side = sign;
        do {
            if (!factor(out, side)) return false;
            side = sign;
            if (take('/')) side = -sign;
            else if (!take('.') && !take('*')) break;
        } while (true);
        --depth_;
        return true;
    }

    bool factor(Product& out, int sign) {
        Product inner;
        if (take('(')) {
            if (!product(inner, 1) || !take(')')) return false;
        } else {
            std::string name;
            while (at_ < text_.size() && (std::isalpha(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_')) name += text_[at_++];
            if (name.empty() && !take('1')) return false;
            if (!name.empty()) inner.emplace_back(name, 1);
        }
        int power = 1;
        if (take('^') && !integer(power)) return false;
        for (const auto& [name, exponent] : inner) add(out, name, sign * power * exponent);
        return true;
    }

    bool integer(int& power) {
        const int sign = take('-') ? -1 : 1;
        const std::size_t begin = at_;
        while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
        if (at_ == begin || at_ - begin > 2) return false;
        power = sign * std::atoi(text_.substr(begin, at_ - begin).c_str());
        return std::abs(power) <= largest_power;
    }

    static void add(Product& out, const std::string& name, int exponent) {
        const auto found = std::find_if(out.begin(), out.end(), [&](const auto& p) { return p.first == name; });
        if (found == out.end()) out.emplace_back(name, exponent);
        else found->second += exponent;
    }

    const std::string& text_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

/// Those of one side, joined; `count` of them.
std::string side(const Product& product, int sign, int& count) {
    std::string out;
    count = 0;
    for (const auto& [name, exponent] : product) {
        if (exponent * sign <= 0) continue;
        const int power = std::abs(exponent);
        out += (out.empty() ? "" : ".") + name + (power == 1 ? "" : "^" + std::to_string(power));
        ++count;
    }
    return out;
}

}  // namespace

std::string tidy(const std::string& unit) {
    const auto product = Parser(unit).whole();
    if (!product) return unit;
    int above_count = 0;
    int below_count = 0;
    const std::string above = side(*product, 1, above_count);
    const std::string below = side(*product, -1, below_count);
    std::string out = above.empty() ? "1" : above;
    if (below_count > 0) out += below_count > 1 ? "/(" + below + ")" : "/" + below;
    const auto same = conversion(unit, out);
    return same && same->scale == 1 && same->offset == 0 ? out : unit;
}

}  // namespace algest::units
