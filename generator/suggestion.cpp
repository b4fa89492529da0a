// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/suggestion.hpp"

#include <algorithm>

namespace algest::model {

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

}  // namespace

std::string suggestion(std::string_view key, const std::vector<std::string>& known) {
    std::string all;
    for (const std::string& k : known) all += (all.empty() ? "" : ", ") + k;
    if (key.size() > 40) return "keys here: " + all;
    const std::string* closest = nullptr;
    std::size_t least = std::max<std::size_t>(1, key.size() / 3) + 1;
    for (const std::string& k : known) {
        const bool one_begins_the_other = std::min(k.size(), key.size()) >= 3 && k.compare(0, key.size(), key, 0, k.size()) == 0;
        const std::size_t d = one_begins_the_other ? 1 : distance(key, k);
        if (d < least) {
            closest = &k;
            least = d;
        }
    }
    return (closest == nullptr ? "" : "did you mean " + *closest + "? ") + "keys here: " + all;
}

}  // namespace algest::model
