// SPDX-License-Identifier: GPL-3.0-or-later
// [filter]: signals that go through the parabola filter, without an estimator.
#include <algorithm>

#include "generator/model_keys.hpp"
#include "generator/model_sections.hpp"
#include "generator/suggestion.hpp"

namespace algest::model {

namespace {

/// The filter knows one kind; the key is there for the next.
void read_kind(const toml::table& t, TomlAccess& file) {
    enum class FilterKind { parabola };
    FilterKind kind = FilterKind::parabola;
    file.choose<FilterKind>(t, "kind", {{"parabola", FilterKind::parabola}}, kind);
}

/// All signals, or those that are listed.
std::vector<int> read_filtered(const toml::table& t, Reading& reading) {
    std::vector<int> out;
    if (!t.contains("signals")) {
        for (std::size_t s = 0; s < reading.model.signals.size(); ++s) out.push_back(static_cast<int>(s));
        return out;
    }
    for (const PlacedText& name : reading.file.strings(t, "signals", "[\"omega\"]")) {
        const int signal = reading.model.signal_index(name.text);
        if (signal < 0) {
            reading.file.error(name.at, quoted(name.text) + " is not a signal", did_you_mean(name.text, signal_names(reading.model)) + "declare it under [signals]");
        } else if (std::count(out.begin(), out.end(), signal) > 0) {
            reading.file.error(name.at, quoted(name.text) + " is listed twice", "list it once");
        } else {
            out.push_back(signal);
        }
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace

void read_filter(const toml::table& root, Reading& reading) {
    TomlAccess& file = reading.file;
    const toml::table* t = file.subtable(root, "filter");
    if (t == nullptr) return;
    for (const char* key : {"equation", "transfer", "parameters", "estimator", "feedback"}) {
        if (root.contains(key)) file.error(*root.get(key), "a model with [filter] estimates nothing", "leave it out, or give the filter a model file of its own");
    }
    file.known_keys(*t, key_names(Where::filter));
    read_kind(*t, file);
    Filter filter{position(*t), read_filtered(*t, reading)};
    if (filter.signals.empty() && file.sound()) file.error(*t, "a filter without signals", "write signals = [\"omega\"], or leave it out: all signals then");
    for (const int s : filter.signals) {
        const Signal& signal = reading.model.signals[static_cast<std::size_t>(s)];
        if (!signal.formula_text.empty()) file.error(signal.at, quoted(signal.name) + " is computed, and a filter runs on measured signals", "list the measured ones: signals = [...]");
    }
    if (!reading.model.period) file.error(*t, "a filter needs the sampling period", "add [sampling] period = 1e-3, in seconds");
    if (reading.model.window) file.error(reading.model.window_at, "a window is for estimators", "leave it out");
    if (reading.model.decimate > 1) file.error(reading.model.sampling_at, "decimate is for estimators", "leave it out");
    reading.model.filter = filter;
}

}  // namespace algest::model
