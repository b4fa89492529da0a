// SPDX-License-Identifier: GPL-3.0-or-later
#include "lab/largest_size.hpp"

#include <algorithm>
#include <cmath>

#include "lab/noise.hpp"
#include "lab/slope.hpp"

namespace algest::lab {

namespace {

using formula::Formula;
using formula::Kind;

/// Empty where something of it is not measured, or it is none of the shapes that roles have.
std::vector<double> series(const Formula& f, const model::Model& model, const Bench& bench) {
    if (f->kind == Kind::name) {
        const int s = model.signal_index(f->name);
        return s < 0 ? std::vector<double>() : bench.measured[static_cast<std::size_t>(s)];
    }
    if (f->kind != Kind::subtract && !formula::is_derivative(f)) return {};
    std::vector<double> out = series(f->arguments[0], model, bench);
    if (out.empty()) return {};
    if (f->kind == Kind::call) return slopes(out, noise_by_signal(model, bench)[static_cast<std::size_t>(model.signal_index(f->arguments[0]->name))], bench.drive.period);
    const std::vector<double> other = series(f->arguments[1], model, bench);
    if (other.empty()) return {};
    for (std::size_t k = 0; k < out.size(); ++k) out[k] -= other[k];
    return out;
}

}  // namespace

double largest_size(const std::string& text, const model::Model& model, const Bench& bench) {
    const auto f = formula::parse(text, [](int, const std::string&, const std::string&) {});
    double out = 0;
    for (const double x : f ? series(*f, model, bench) : std::vector<double>()) if (std::isfinite(x)) out = std::max(out, std::abs(x));
    return out > 0 ? out : 1;
}

}  // namespace algest::lab
