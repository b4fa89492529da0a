// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/units.hpp"

#include <udunits2.h>

#include <algorithm>
#include <map>

#include "generator/diagnostics.hpp"

namespace algest::units {

namespace {

/// The unit system of UDUNITS, read once.
ut_system* unit_system() {
    static ut_system* const system = [] {
        ut_set_error_message_handler(ut_ignore);
        return ut_read_xml(nullptr);
    }();
    return system;
}

struct FreeUnit {
    void operator()(void* unit) const { ut_free(static_cast<ut_unit*>(unit)); }
};

ut_unit* raw(const std::shared_ptr<void>& unit) { return static_cast<ut_unit*>(unit.get()); }

std::shared_ptr<void> own(ut_unit* unit) {
    return unit == nullptr ? nullptr : std::shared_ptr<void>(unit, FreeUnit());
}

}  // namespace

Unit Unit::dimensionless() {
    Unit out;
    out.unit_ = own(ut_get_dimensionless_unit_one(unit_system()));
    return out;
}

std::optional<Unit> Unit::parse(const std::string& text) {
    if (text == "-" || text.empty()) return dimensionless();
    Unit out;
    out.unit_ = own(ut_parse(unit_system(), text.c_str(), UT_UTF8));
    if (!out.unit_) return std::nullopt;
    return out;
}

Unit Unit::times(const Unit& other) const {
    Unit out;
    if (known() && other.known()) out.unit_ = own(ut_multiply(raw(unit_), raw(other.unit_)));
    return out;
}

Unit Unit::over(const Unit& other) const {
    Unit out;
    if (known() && other.known()) out.unit_ = own(ut_divide(raw(unit_), raw(other.unit_)));
    return out;
}

Unit Unit::power(int exponent) const {
    Unit out;
    if (known()) out.unit_ = own(ut_raise(raw(unit_), exponent));
    return out;
}

Unit Unit::root(int degree) const {
    Unit out;
    if (known()) out.unit_ = own(ut_root(raw(unit_), degree));
    return out;
}

bool Unit::same_dimension(const Unit& other) const {
    return known() && other.known() && ut_are_convertible(raw(unit_), raw(other.unit_)) != 0;
}

double Unit::factor_to(const Unit& other) const {
    cv_converter* converter = ut_get_converter(raw(unit_), raw(other.unit_));
    if (converter == nullptr) return 0.0;
    const double factor = cv_convert_double(converter, 1.0) - cv_convert_double(converter, 0.0);
    cv_free(converter);
    return factor;
}

bool Unit::same_origin(const Unit& other) const {
    cv_converter* converter = ut_get_converter(raw(unit_), raw(other.unit_));
    if (converter == nullptr) return false;
    const double offset = cv_convert_double(converter, 0.0);
    cv_free(converter);
    return offset == 0.0;
}

std::string Unit::text() const {
    if (!known()) return "?";
    char buffer[256];
    const int length = ut_format(raw(unit_), buffer, sizeof buffer, UT_ASCII);
    if (length < 0 || length >= static_cast<int>(sizeof buffer)) return "?";
    return std::string(buffer, static_cast<std::size_t>(length));
}

std::optional<std::string> right_spelling(const std::string& text) {
    static const std::map<std::string, std::string> known = {
        {"Nm", "N.m"}, {"Nms", "N.m.s"}, {"Nms/rad", "N.m.s/rad"}, {"Nm/A", "N.m/A"}, {"Nm/rad", "N.m/rad"},
        {"Nm/V", "N.m/V"}, {"Nms^2", "N.m.s^2"}, {"Nm.s/rad", "N.m.s/rad"}, {"Nm.s", "N.m.s"}, {"Ns/m", "N.s/m"},
        {"Ns", "N.s"}, {"Ns2/m", "N.s^2/m"}, {"Ns2/m2", "N.s^2/m^2"}, {"Ns^2/m^2", "N.s^2/m^2"}, {"Ns/m2", "N.s/m^2"},
        {"kgm2", "kg.m^2"}, {"kgm^2", "kg.m^2"}, {"kgm", "kg.m"}, {"kgcm2", "kg.cm^2"}, {"gcm2", "g.cm^2"},
        {"Vs", "V.s"}, {"Vs/rad", "V.s/rad"}, {"As", "A.s"}, {"Ws", "W.s"}, {"Js", "J.s"}, {"Wbm", "Wb.m"},
        {"ohmm", "ohm.m"}, {"Ohm", "ohm"}, {"Ohms", "ohm"}, {"mNm", "mN.m"}, {"kNm", "kN.m"}, {"Nm2/A2", "N.m^2/A^2"},
        {"Nm^2/A^2", "N.m^2/A^2"}, {"radian/sec", "rad/s"}, {"deg/s", "degree/s"}, {"deg", "degree"}, {"rev/min", "rpm"}, {"r/min", "rpm"}, {"U/min", "rpm"}, {"rev/s", "revolution/s"}, {"rps", "revolution/s"}, {"RPM", "rpm"}, {"mtr", "m"},
    };
    const auto found = known.find(text);
    if (found == known.end()) return std::nullopt;
    return found->second;
}

std::optional<UnitFault> fault_of_unit(const std::string& text) {
    constexpr std::size_t longest = 60;
    if (const auto right = right_spelling(text)) return UnitFault{quoted(text) + " is not a unit", "write " + *right};
    const bool control = std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
    if (!control && text.size() <= longest && Unit::parse(text)) return std::nullopt;
    return UnitFault{"UDUNITS does not know the unit " + quoted(text), "write products with points and powers with ^: N.m, kg.m^2, rad/s"};
}

bool mentions_hertz(const std::string& text) {
    for (std::size_t at = text.find("Hz"); at != std::string::npos; at = text.find("Hz", at + 1)) {
        if (at + 2 == text.size() || std::isalpha(static_cast<unsigned char>(text[at + 2])) == 0) return true;
    }
    return text.find("hertz") != std::string::npos;
}

bool takes_turns_for_radians(const std::string& from, const std::string& to) {
    const auto has_angle = [](const std::string& unit) {
        for (const char* angle : {"rad", "deg", "rev", "rpm", "turn", "cycle", "grad", "gon", "arc", "\u00b0"}) if (unit.find(angle) != std::string::npos) return true;
        return false;
    };
    const auto a = Unit::parse(from);
    const auto rate = Unit::parse("1/s");
    return a && a->same_dimension(*rate) && has_angle(to) && !has_angle(from);
}

std::optional<Conversion> conversion(const std::string& from, const std::string& to) {
    const auto a = Unit::parse(from);
    const auto b = Unit::parse(to);
    if (!a || !b || !a->same_dimension(*b)) return std::nullopt;
    if (from == to) return Conversion{1.0, 0.0};
    // One number through the converter at 0 and at 1 gives the straight line.
    const double scale = a->factor_to(*b);
    ut_unit* source = ut_parse(unit_system(), from.empty() || from == "-" ? "1" : from.c_str(), UT_UTF8);
    ut_unit* target = ut_parse(unit_system(), to.empty() || to == "-" ? "1" : to.c_str(), UT_UTF8);
    cv_converter* converter = ut_get_converter(source, target);
    const double offset = converter == nullptr ? 0.0 : cv_convert_double(converter, 0.0);
    cv_free(converter);
    ut_free(source);
    ut_free(target);
    return Conversion{scale, offset};
}

}  // namespace algest::units
