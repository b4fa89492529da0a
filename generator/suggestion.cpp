// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/suggestion.hpp"

#include <algorithm>
#include <cctype>

namespace algest {

namespace {

/// Letters to insert, remove, change or swap with the next to get from one word to the other.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1, 0));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

std::string small(std::string_view word) {
    std::string out(word);
    for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

/// 0: they differ by case alone; the beginning of a word counts as one mistake.
std::size_t mistakes(const std::string& a, const std::string& b) {
    const bool one_begins_the_other = a != b && std::min(a.size(), b.size()) >= 3 && b.compare(0, a.size(), a, 0, b.size()) == 0;
    return one_begins_the_other ? 1 : distance(a, b);
}

}  // namespace

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
    constexpr std::size_t longest = 40;
    if (word.size() > longest) return {};
    const std::string written = small(word);
    const std::string* nearest = nullptr;
    bool alone = false;
    std::size_t least = std::min(std::max<std::size_t>(1, word.size() / 3), word.size() - 1) + 1;   // never a whole new word
    for (const std::string& k : known) {
        const std::size_t count = mistakes(written, small(k));
        if (nearest != nullptr && count == least) alone = false;
        if (count >= least) continue;
        nearest = &k;
        least = count;
        alone = true;
    }
    return alone ? "did you mean " + *nearest + "? " : std::string();
}

}  // namespace algest
