// SPDX-License-Identifier: GPL-3.0-or-later
// TOML -> Model, section by section (model_sections.hpp). Formulas go to `formula`, dimensions to `dimension`.
#include "generator/model.hpp"

#include <algorithm>

#include "generator/model_keys.hpp"
#include "generator/model_sections.hpp"
#include "generator/names.hpp"
#include "generator/source_text.hpp"
#include "generator/toml_file.hpp"

namespace algest::model {

namespace {

/// name, summary, source.
void read_head(const toml::table& root, Reading& reading) {
    TomlAccess& file = reading.file;
    if (const auto name = file.string(root, "name")) {
        reading.model.name = *name;
        if (const auto fault = fault_of_model_name(*name)) file.error(*root.get("name"), fault->what, fault->right);
    } else if (!root.contains("name")) {
        file.error(Position{1, 1}, "no name", "add name = \"dc_motor\"");
    }
    const auto prose = [&](const char* key) {
        const auto text = file.string(root, key);
        if (!text) return std::string();
        if (const auto fault = fault_of_prose(*text)) file.error(*root.get(key), fault->what, fault->right);
        return *text;
    };
    reading.model.summary = prose("summary");
    reading.model.source = prose("source");
}

void read_sections(const toml::table& root, Reading& reading) {
    TomlAccess& file = reading.file;
    file.known_keys(root, key_names(Where::top));
    read_head(root, reading);
    read_sampling(root, reading);
    read_signals(root, reading);
    read_constants(root, reading);
    read_parameters(root, reading);
    read_estimator(root, reading);
    read_formulas(root, reading);
    read_discrete(root, reading);
    read_filter(root, reading);
    if (!reading.model.filter) read_equations(root, reading);
    read_feedback(root, reading);
    if (!root.contains("signals")) file.error(Position{1, 1}, "no [signals]", "declare what is measured: y = { unit = \"rad\" }");
}

}  // namespace

Position Equation::place(int offset) const {
    if (places.empty()) return at;
    return places[std::min(static_cast<std::size_t>(std::max(offset, 0)), places.size() - 1)];
}

std::optional<Rational> Signal::deviation() const {
    const Rational sigma = noise.value_or(Rational(0));
    const Rational step = resolution.value_or(Rational(0));
    if (cln::zerop(step)) return cln::zerop(sigma) ? std::nullopt : noise;
    return exact::function_value("sqrt", sigma * sigma + step * step / 12);
}

const Signal* Model::signal(const std::string& wanted) const {
    for (const Signal& s : signals) if (s.name == wanted) return &s;
    return nullptr;
}
const Constant* Model::constant(const std::string& wanted) const {
    for (const Constant& c : constants) if (c.name == wanted) return &c;
    return nullptr;
}
const Parameter* Model::parameter(const std::string& wanted) const {
    for (const Parameter& p : parameters) if (p.name == wanted) return &p;
    return nullptr;
}
int Model::signal_index(const std::string& wanted) const {
    const Signal* s = signal(wanted);
    return s == nullptr ? -1 : static_cast<int>(s - signals.data());
}
int Model::parameter_index(const std::string& wanted) const {
    const Parameter* p = parameter(wanted);
    return p == nullptr ? -1 : static_cast<int>(p - parameters.data());
}

std::vector<std::string> signal_names(const Model& model) {
    std::vector<std::string> out;
    for (const Signal& s : model.signals) out.push_back(s.name);
    return out;
}

std::optional<Model> read(const std::string& path, bool strict, Diagnostics& diagnostics) {
    const auto text = read_text(path, largest_file, diagnostics);
    return text ? read_from_text(*text, path, strict, diagnostics) : std::nullopt;
}

std::optional<Model> read_from_text(const std::string& text, const std::string& path, bool strict, Diagnostics& diagnostics) {
    Model model;
    model.path = path;
    read_toml(path, text, "docs/model-file.md has the format", diagnostics, [&](const toml::table& root, TomlAccess& file) {
        Reading reading{file, model, strict};
        read_sections(root, reading);
    });
    if (diagnostics.has_errors()) return std::nullopt;
    return model;
}

}  // namespace algest::model
