// SPDX-License-Identifier: GPL-3.0-or-later
// The class that a plan generates, compiled by a chosen compiler with chosen flags and loaded into the test. Its symbols are
// hidden: the dynamic linker would else give the tables of the first class to all of the same name.
#pragma once
#include <dlfcn.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "generator/generate.hpp"
#include "tests/lab/temporary_file.hpp"

namespace algest::test {

/// S: the plan's scalar. An answer is the status as a number, the condition, the parameters.
template <class S>
class CompiledEstimator {
public:
    CompiledEstimator(const plan::Plan& plan, const std::string& compiler) : width_(2 + plan.parameters.size()) {
        const TemporaryFolder folder;
        std::filesystem::create_directory(folder.path(plan.name));
        for (const generator::EmittedFile& file : generator::emit(plan)) folder.write(file.path, file.text);
        const std::string log = folder.path("log");
        const std::string command = compiler +
                                    " -std=c++17 -fno-exceptions -fno-rtti -w -ffp-contract=off "
                                    "-fPIC -shared -fvisibility=hidden -I " ALGEST_SOURCE "/runtime/include -I " +
                                    folder.path(".") + " " + folder.write("shared.cpp", source(plan)) + " -o " +
                                    folder.path("shared.so") + " >" + log + " 2>&1";
        const int status = std::system(command.c_str());
        if (status != 0) std::system(("cat " + log).c_str());
        INFO(command);
        REQUIRE(status == 0);
        library_.reset(::dlopen(folder.path("shared.so").c_str(), RTLD_NOW | RTLD_LOCAL));
        REQUIRE(library_);
        step_ = reinterpret_cast<void (*)(const S*, S*)>(::dlsym(library_.get(), "step"));
        reset_ = reinterpret_cast<void (*)()>(::dlsym(library_.get(), "reset"));
        uncertainty_ = reinterpret_cast<void (*)(S*)>(::dlsym(library_.get(), "uncertainty"));
        estimated_ = static_cast<std::size_t>(plan.estimated());
        REQUIRE(step_ != nullptr);
        REQUIRE((uncertainty_ != nullptr) == plan.uncertain());
        REQUIRE(reset_ != nullptr);
    }

    void reset() { reset_(); }
    std::vector<S> step(const S* inputs) {
        std::vector<S> out(width_);
        step_(inputs, out.data());
        return out;
    }

    /// Status as a number, standard deviations, biases. Only for plans with noise.
    std::vector<S> uncertainty() {
        std::vector<S> out(1 + 2 * estimated_);
        uncertainty_(out.data());
        return out;
    }

private:
    static std::string source(const plan::Plan& plan) {
        std::string out = "#include \"" + plan.name + "/" + plan.name + ".hpp\"\n";
        out += "using Class = algest::generated::" + plan.class_name + ";\nstatic Class estimator;\n";
        out += "#define SHOWN extern \"C\" __attribute__((visibility(\"default\"))) void\n";
        out += "SHOWN reset() { estimator.reset(); }\n";
        out += "SHOWN step(const Class::Scalar* in, Class::Scalar* out) {\n    Class::Sample s;\n";
        for (std::size_t i = 0; i < plan.inputs.size(); ++i) {
            out += "    s." + plan.inputs[i].name + " = in[" + std::to_string(i) + "];\n";
        }
        out += "    const Class::Estimate e = estimator.step(s);\n";
        out += "    out[0] = Class::Scalar(static_cast<int>(e.status));\n    out[1] = e.condition;\n";
        for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
            out += "    out[" + std::to_string(p + 2) + "] = e." + plan.parameters[p].name + ";\n";
        }
        out += "}\n";
        if (!plan.uncertain()) return out;
        out += "SHOWN uncertainty(Class::Scalar* out) {\n    const Class::Uncertainty u = estimator.uncertainty();\n";
        out += "    out[0] = Class::Scalar(static_cast<int>(u.status));\n";
        const int estimated = plan.estimated();
        for (int p = 0; p < estimated; ++p) {
            const std::string& name = plan.parameters[static_cast<std::size_t>(p)].name;
            out += "    out[" + std::to_string(1 + p) + "] = u.sd." + name + ";\n";
            out += "    out[" + std::to_string(1 + estimated + p) + "] = u.bias." + name + ";\n";
        }
        return out + "}\n";
    }

    struct Close {
        void operator()(void* library) const { ::dlclose(library); }
    };

    std::size_t width_;
    std::unique_ptr<void, Close> library_;
    void (*step_)(const S*, S*) = nullptr;
    void (*reset_)() = nullptr;
    void (*uncertainty_)(S*) = nullptr;
    std::size_t estimated_ = 0;
};

}  // namespace algest::test
