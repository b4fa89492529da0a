// SPDX-License-Identifier: GPL-3.0-or-later
// Units in UDUNITS syntax: spelling, dimension, conversion.
#pragma once
#include <memory>
#include <optional>
#include <string>

namespace algest::units {

/// A unit, or "not known" (nothing was declared, or it cannot be expressed): arithmetic with it stays unknown.
class Unit {
public:
    Unit() = default;                                  ///< unknown
    static Unit dimensionless();
    static std::optional<Unit> parse(const std::string& text);   ///< nullopt: UDUNITS does not know it

    bool known() const { return unit_ != nullptr; }
    Unit times(const Unit& other) const;
    Unit over(const Unit& other) const;
    Unit power(int exponent) const;
    Unit root(int degree) const;                       ///< unknown where the root has no unit
    bool same_dimension(const Unit& other) const;      ///< both known and convertible
    /// The number by which a value in this unit is multiplied to be in `other` (offsets of temperatures left out).
    double factor_to(const Unit& other) const;
    /// True when zero in this unit is zero in `other`: not so for degC and K.
    bool same_origin(const Unit& other) const;
    /// As UDUNITS prints it, in base units where no shorter name exists.
    std::string text() const;

private:
    std::shared_ptr<void> unit_;
};

/// What to write instead of a usual misspelling (`Nm`, `Ns/m`, `kgm2`, ...); nullopt if the text is not one.
std::optional<std::string> right_spelling(const std::string& text);

/// What is wrong with a text as a unit, and what would be right; nullopt if UDUNITS knows it.
struct UnitFault {
    std::string what;
    std::string right;
};
std::optional<UnitFault> fault_of_unit(const std::string& text);

/// True when the unit is hertz, or contains it: UDUNITS converts Hz to rad/s with factor 1.
bool mentions_hertz(const std::string& text);

/// True for a rate without an angle (1/min, Hz) that is to be read as an angular speed (rad/s): UDUNITS takes a turn for a radian.
bool takes_turns_for_radians(const std::string& from, const std::string& to);

/// value_in_to = scale * value_in_from + offset.
struct Conversion {
    double scale;
    double offset;
};
/// Nullopt: a unit is not known, or the dimensions differ. "-" and "1" and "" are dimensionless.
std::optional<Conversion> conversion(const std::string& from, const std::string& to);

}  // namespace algest::units
