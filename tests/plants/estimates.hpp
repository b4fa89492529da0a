// SPDX-License-Identifier: GPL-3.0-or-later
// A model's text to a plan, a plan over samples to estimates, estimates to errors.
#pragma once
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "generator/generate.hpp"
#include "lab/host_estimator.hpp"
#include "tests/lab/temporary_file.hpp"

namespace algest::plants {

/// The plan of a model file's text. A complaint fails the test.
inline plan::Plan plan_of(const std::string& model, plan::Scalar scalar = plan::Scalar::float64) {
    const test::TemporaryFolder folder;
    Diagnostics diagnostics;
    const auto plan = generator::plan_from_model(folder.write("model.toml", model), {scalar, ""}, diagnostics);
    for (const Diagnostic& d : diagnostics.sorted()) {
        if (!plan || d.severity == Severity::error) UNSCOPED_INFO(d.text());
    }
    REQUIRE(plan);
    return *plan;
}

struct Estimate {
    Status status;
    double condition;
    std::vector<double> parameters;
};

/// One estimate a sample; a sample holds the plan's inputs in their order.
template <class S = double>
std::vector<Estimate> estimates(const plan::Plan& plan, const std::vector<std::vector<double>>& samples) {
    lab::HostEstimator<S> estimator(plan);
    std::vector<Estimate> out;
    for (const std::vector<double>& sample : samples) {
        REQUIRE(sample.size() == plan.inputs.size());
        const std::vector<S> inputs(sample.begin(), sample.end());
        const Status status = estimator.step(inputs.data());
        out.push_back({status,
                       static_cast<double>(estimator.condition()),
                       {estimator.parameters().begin(), estimator.parameters().end()}});
    }
    return out;
}

/// The first `ok` one: read when the window first fills.
inline const Estimate& first_ok(const std::vector<Estimate>& all) {
    const auto found = std::find_if(all.begin(), all.end(), [](const Estimate& e) { return e.status == Status::ok; });
    REQUIRE(found != all.end());
    return *found;
}

inline double relative_error(double estimate, double truth) { return std::abs(estimate / truth - 1.0); }

/// Largest over the parameters.
inline double worst_error(const std::vector<double>& parameters, const std::vector<double>& truth) {
    REQUIRE(parameters.size() == truth.size());
    double worst = 0.0;
    for (std::size_t p = 0; p < truth.size(); ++p) worst = std::max(worst, relative_error(parameters[p], truth[p]));
    return worst;
}

inline double median(std::vector<double> values) {
    REQUIRE_FALSE(values.empty());
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// Relative errors of one parameter at the ok samples from `begin` on. Fails if none is ok.
inline std::vector<double> errors(const std::vector<Estimate>& all, std::size_t begin, std::size_t parameter, double truth) {
    std::vector<double> out;
    for (std::size_t k = begin; k < all.size(); ++k) {
        if (all[k].status == Status::ok) out.push_back(relative_error(all[k].parameters[parameter], truth));
    }
    REQUIRE_FALSE(out.empty());
    return out;
}

inline double worst(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

}  // namespace algest::plants
