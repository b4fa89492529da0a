// SPDX-License-Identifier: GPL-3.0-or-later
// Which of two sets of effects is named where a free run explains the recording alike with either.
#pragma once
#include <string>
#include <vector>

#include "lab/effects.hpp"
#include "lab/variant.hpp"

namespace algest::lab {

/// A fitted set of effects, and the F statistic of the weak residual's reduction by the last one.
struct Contender {
    const Variant* variant;
    double strength;
};

class Precedence {
public:
    /// effects: the library; outlives it.
    explicit Precedence(const std::vector<Effect>& effects) : effects_(effects) {}

    /// a is the plainer account: fewer of its effects hang on nothing in the machine (a wave of time) or bend the model instead of adding to
    /// it; then, it has less to fit; then, its effect's rival says so in its file; then, the rows of its equation see it, those of the other one do not.
    bool before(const Contender& a, const Contender& b) const;

    /// Where validation does not tell the two apart: true when the rows that both were fitted to, with the declared start where one of them corrects a sensor, speak for `a` beyond doubt, though it is the less plain account. Only of
    /// effects that add to the model alike, or of one that bends it and has no more to fit: the others fit anything a little.
    bool fitted_rows_tell(const Variant& a, const Variant& b) const;

    /// What `other` is beside the set that is named.
    enum class Standing {
        nothing,
        as_well,   ///< a rival by the effects' files, or one to the last digit, but the less plain account
        rival      ///< else; also a less plain account that the fitted rows prefer, but not beyond doubt
    };
    Standing beside(const Contender& named, const Contender& other) const;

    /// Of a set that stands as_well: a sentence for the reader.
    std::string doubt(const Variant& named, const Variant& other) const;

private:
    const Effect& effect_of(const Amendment& amendment) const;
    int held_back(const Variant& v) const;
    bool are_rivals(const Variant& a, const Variant& b) const;
    bool yields(const Variant& a, const Variant& to) const;

    const std::vector<Effect>& effects_;
};

/// Parameters and constants that the effects of a set bring.
int added_parameters(const Variant& v);

}  // namespace algest::lab
