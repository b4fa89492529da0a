// SPDX-License-Identifier: GPL-3.0-or-later
// The host estimator and the compiled generated class, to the last bit: every model of models/, on both engines, in double and in float, on
// samples among which some are not finite.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "generator/generate.hpp"
#include "lab/host_estimator.hpp"
#include "tests/lab/temporary_file.hpp"

using namespace algest;

namespace {

constexpr int restarts = 3;  // stretches between samples that are refused

/// The program that a user would write: samples from a file, what step() answers into another, all as raw scalars.
std::string program(const plan::Plan& plan) {
    std::string out = "#include <cstdio>\n#include \"" + plan.name + "/" + plan.name + ".hpp\"\n";
    out += "int main(int, char** files) {\n    static algest::generated::" + plan.class_name + " estimator;\n";
    out += "    using Estimator = algest::generated::" + plan.class_name + ";\n    Estimator::Sample s;\n";
    out += "    std::FILE* in = std::fopen(files[1], \"rb\");\n    std::FILE* out = std::fopen(files[2], \"wb\");\n";
    out += "    while (std::fread(&s, sizeof s, 1, in) == 1) {\n        const auto e = estimator.step(s);\n";
    out += "        const Estimator::Scalar values[] = {Estimator::Scalar(static_cast<int>(e.status)), e.condition";
    for (const plan::Parameter& p : plan.parameters) out += ", e." + p.name;
    return out + "};\n        std::fwrite(values, sizeof values, 1, out);\n    }\n    return std::fclose(out);\n}\n";
}

/// Smooth inputs with noise, enough to fill everything after each of the refused samples.
template <class S>
std::vector<S> samples(const plan::Plan& plan) {
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0.0, 0.01);
    const bool turns = plan.name == "servo";   // it has to turn, and to turn back; others may divide by an air gap
    const bool has_noise = plan.name == "pmsm_electrical";   // which its currents have to exceed
    const double middle = turns ? 0.0 : has_noise ? 3.0 : 0.003;
    const double size = turns ? 1.0 : has_noise ? 2.0 : 0.002;
    const int instants = plan.samples() + plan.solve_instants + (turns ? 400 : 50);
    const std::size_t inputs = plan.inputs.size();
    std::vector<S> out;
    for (int k = 0; k < restarts * instants; ++k) {
        for (std::size_t i = 0; i < inputs; ++i) {
            const double phase = (0.01 + 0.007 * static_cast<double>(i)) * k;
            out.push_back(static_cast<S>(middle + size * (std::sin(phase) + 0.3 * std::cos(2.9 * phase) + noise(random))));
        }
    }
    const auto bad = [&](int instant, S value) {
        const auto k = static_cast<std::size_t>(instant);
        out[k * inputs + k % inputs] = value;
    };
    bad(instants, std::numeric_limits<S>::quiet_NaN());
    bad(2 * instants, std::numeric_limits<S>::infinity());
    bad(2 * instants + 1, -std::numeric_limits<S>::infinity());  // the sample that primes is refused, too
    return out;
}

template <class S>
std::vector<S> host_answers(const plan::Plan& plan, const std::vector<S>& samples) {
    lab::HostEstimator<S> estimator(plan);
    std::vector<S> out;
    for (std::size_t k = 0; k < samples.size(); k += plan.inputs.size()) {
        out.push_back(static_cast<S>(static_cast<int>(estimator.step(samples.data() + k))));
        out.push_back(estimator.condition());
        out.insert(out.end(), estimator.parameters().begin(), estimator.parameters().end());
    }
    return out;
}

template <class S>
std::vector<S> compiled_answers(const plan::Plan& plan, const std::vector<S>& samples) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder.path(plan.name));
    for (const generator::EmittedFile& file : generator::emit(plan)) folder.write(file.path, file.text);
    const std::string source = folder.write("program.cpp", program(plan));
    const std::string in = folder.write("in", {reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(S)});
    const std::string compile = "c++ -std=c++17 -O2 -ffp-contract=off -I " ALGEST_SOURCE "/runtime/include -I " +
                                folder.path(".") + " " + source + " -o " + folder.path("program");
    REQUIRE(std::system(compile.c_str()) == 0);
    REQUIRE(std::system((folder.path("program") + " " + in + " " + folder.path("out")).c_str()) == 0);
    std::ifstream file(folder.path("out"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::vector<S> out(bytes.size() / sizeof(S));
    std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
}

template <class S>
void compare(const std::string& model, plan::Scalar scalar, const std::string& engine) {
    Diagnostics diagnostics;
    const auto plan = generator::plan_from_model(model, {scalar, engine}, diagnostics);
    for (const Diagnostic& d : diagnostics.sorted()) UNSCOPED_INFO(d.text());
    REQUIRE(plan);
    if (plan->elimination) return;   // asks for operating points: tests/generated/operating_points.cpp
    const std::vector<S> fed = samples<S>(*plan);
    const std::vector<S> host = host_answers(*plan, fed);
    const std::vector<S> compiled = compiled_answers(*plan, fed);
    REQUIRE(host.size() == compiled.size());

    const std::size_t width = 2 + plan->parameters.size();
    std::size_t ok = 0;
    std::size_t different = 0;
    std::size_t rejected = 0;
    for (std::size_t k = 0; k < host.size(); k += width) {
        ok += host[k] == S(static_cast<int>(Status::ok)) ? 1U : 0U;
        rejected += host[k] == S(static_cast<int>(Status::rejected)) ? 1U : 0U;
        different += std::memcmp(host.data() + k, compiled.data() + k, width * sizeof(S)) != 0 ? 1U : 0U;
    }
    INFO(model << ", " << engine << (scalar == plan::Scalar::float64 ? ", double: " : ", float: ") << ok << " samples ok");
    CHECK(rejected == 3);
    CHECK(ok > 50);
    CHECK(different == 0);
}

}  // namespace

TEST_CASE("the host estimator and the generated class agree to the last bit") {
    std::size_t models = 0;
    std::size_t on_moments = 0;
    for (const auto& entry : std::filesystem::directory_iterator(ALGEST_SOURCE "/models")) {
        if (entry.path().extension() != ".toml") continue;
        ++models;
        for (const char* engine : {"fir", "moments"}) {
            Diagnostics diagnostics;
            const auto plan = generator::plan_from_model(entry.path().string(), {plan::Scalar::float64, engine, false}, diagnostics);
            REQUIRE(plan);
            if (engine == std::string("moments") && !plan->moments) continue;   // fell back to fir
            on_moments += plan->moments ? 1 : 0;
            compare<double>(entry.path().string(), plan::Scalar::float64, engine);
            compare<float>(entry.path().string(), plan::Scalar::float32, engine);
        }
    }
    CHECK(models >= 6);
    CHECK(on_moments == 7);   // dc_motor, magnetic_bearing, pendulum, pmsm_electrical, pmsm_inertia, positioning_axis, rl_circuit
}
