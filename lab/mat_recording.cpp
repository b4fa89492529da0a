// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/mat_recording.hpp"

#include <fmt/format.h>
#include <matio.h>

#include <cmath>
#include <memory>
namespace algest::lab {

namespace {

constexpr int digits_of_a_double = 17;   // what a number of such a file is written with

struct CloseFile {
    void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
    void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, CloseFile>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

bool is_number(const matvar_t& v) { return v.class_type >= MAT_C_DOUBLE && v.class_type <= MAT_C_UINT64 && v.isComplex == 0; }

/// Elements of a vector, either way it lies; 0: it is none.
std::size_t length(const matvar_t& v) {
    if (v.rank != 2 || v.dims == nullptr || (v.dims[0] != 1 && v.dims[1] != 1)) return 0;
    return v.dims[0] * v.dims[1];
}

/// A damaged file may promise more elements than it has.
template <class Number>
bool holds(const matvar_t& v) {
    return v.data != nullptr && v.nbytes / sizeof(Number) >= length(v);
}

template <class Number>
std::vector<double> as_doubles(const matvar_t& v) {
    if (!holds<Number>(v)) return {};
    const auto* const data = static_cast<const Number*>(v.data);
    return std::vector<double>(data, data + length(v));
}

/// Empty where there are none, or where the file gives them in a type that it does not say of the variable.
std::vector<double> numbers(const matvar_t& v) {
    switch (v.data_type) {
        case MAT_T_DOUBLE: return as_doubles<double>(v);
        case MAT_T_SINGLE: return as_doubles<float>(v);
        case MAT_T_INT8: return as_doubles<mat_int8_t>(v);
        case MAT_T_UINT8: return as_doubles<mat_uint8_t>(v);
        case MAT_T_INT16: return as_doubles<mat_int16_t>(v);
        case MAT_T_UINT16: return as_doubles<mat_uint16_t>(v);
        case MAT_T_INT32: return as_doubles<mat_int32_t>(v);
        case MAT_T_UINT32: return as_doubles<mat_uint32_t>(v);
        default: return {};
    }
}

/// The text of a field of the struct `units`; nullopt: it has none.
std::optional<std::string> unit_of(matvar_t* units, const std::string& name) {
    if (units == nullptr || units->class_type != MAT_C_STRUCT) return std::nullopt;
    const matvar_t* field = Mat_VarGetStructFieldByName(units, name.c_str(), 0);
    if (field == nullptr || field->class_type != MAT_C_CHAR) return std::nullopt;
    const bool wide = field->data_size == 2;
    if (!(wide ? holds<mat_uint16_t>(*field) : holds<mat_uint8_t>(*field))) return std::nullopt;
    std::string out;
    for (std::size_t k = 0; k < length(*field); ++k) out += static_cast<char>(wide ? static_cast<const mat_uint16_t*>(field->data)[k] : static_cast<const mat_uint8_t*>(field->data)[k]);
    return out;
}

/// Reads one file into a Recording. Its places are elements, "u(12)", for it has no lines.
class MatReader {
public:
    MatReader(const std::string& path, TimeBase time, Diagnostics& diagnostics) : path_(path), time_base_(time), diagnostics_(diagnostics) { recording_.file = path; }

    std::optional<Recording> read() {
        const File file(Mat_Open(path_.c_str(), MAT_ACC_RDONLY));
        if (!file) return refuse("cannot be read as a MATLAB file", "a file of MATLAB's `save`, or a CSV file with another ending");
        units_.reset(Mat_VarRead(file.get(), "units"));
        const Variable time(Mat_VarRead(file.get(), "t"));
        if (!time || !is_number(*time) || length(*time) < 2) return refuse("there is no vector `t` of two instants or more", "save(\"run.mat\", \"t\", \"u\", \"y\")");
        samples_ = length(*time);
        Mat_Rewind(file.get());
        while (const Variable v{Mat_VarReadNext(file.get())}) take(*v);
        if (diagnostics_.has_errors() || !check_time()) return std::nullopt;
        return std::move(recording_);
    }

private:
    std::nullopt_t refuse(const std::string& what, const std::string& right) {
        diagnostics_.error(path_, {}, what, right);
        return std::nullopt;
    }

    void take(const matvar_t& v) {
        const std::string name = v.name == nullptr ? "" : v.name;
        if (name == "units") return;
        if (!is_number(v) || length(v) != samples_) {
            diagnostics_.note(path_, fmt::format("variable {} is left out: no vector of {} real numbers, as `t` is", quoted(name), samples_));
            return;
        }
        Column column{name, unit_of(units_.get(), name), 0, numbers(v)};
        if (column.values.size() != samples_) {
            refuse("variable " + quoted(name) + " cannot be read", "numbers of type double");
            return;
        }
        for (std::size_t k = 0; k < samples_; ++k) {
            if (std::isfinite(column.values[k])) continue;
            refuse(fmt::format("{}({}) is not finite", name, k + 1), "finite numbers, or a shorter recording");
            return;
        }
        if (name == "t" && !column.unit) column.unit = "s";
        recording_.columns.push_back(std::move(column));
    }

    bool check_time() {
        const Column& t = *recording_.column("t");
        const auto seconds = units::conversion(*t.unit, "s");
        if (!seconds) {
            refuse("the unit " + quoted(*t.unit) + " of `t` is not one of time", "units.t = \"s\"");
            return false;
        }
        const TimeCheck check = algest::lab::check_time(t.values, {0, digits_of_a_double}, time_base_);
        if (!check.uniform) {
            const UnevenStep& u = *check.uneven;
            refuse(fmt::format("`t` is not uniform: a step of {:.6g} {} at t({}), {:.6g} {} elsewhere", u.step, *t.unit, u.row + 1, u.period, *t.unit), "equal steps, that increase");
            return false;
        }
        recording_.set_time(t.values, *check.uniform, *seconds);
        return true;
    }

    std::string path_;
    TimeBase time_base_;
    Diagnostics& diagnostics_;
    Variable units_;
    std::size_t samples_ = 0;
    Recording recording_{};
};

}  // namespace

std::optional<Recording> read_mat_recording(const std::string& path, TimeBase time, Diagnostics& diagnostics) { return MatReader(path, time, diagnostics).read(); }

}  // namespace algest::lab
