// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a case, in the layout of ../shared/cases.
#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "case.hpp"
#include "rounding.hpp"

namespace algest::gap {

namespace {

using nlohmann::ordered_json;

std::string number(double v) {
    std::string text = fmt::format("{}", v);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

/// Parameters and states of the effect at `index`, x_NAME in its texts, under names of their own: two effects may use the same ones.
std::string own(std::string text, std::size_t index) {
    const std::string with = "x" + std::to_string(index + 1) + "_";
    for (std::size_t at = 0; (at = text.find("x_", at)) != std::string::npos; at += with.size()) {
        const bool whole = at == 0 || !std::isalnum(static_cast<unsigned char>(text[at - 1]));  // not the end of max_...
        if (whole) text.replace(at, 2, with);
    }
    return text;
}

/// A formula with one name in place of another.
std::string with_word(const std::string& text, const std::string& word, const std::string& with) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_')) ++end;
        if (end == i) ++end;
        const std::string part = text.substr(i, end - i);
        out += part == word ? with : part;
        i = end;
    }
    return out;
}

std::string unit_of(const std::string& unit) { return unit.empty() ? "" : fmt::format(", unit = \"{}\"", unit); }

/// `truth`: true values in place of guesses, and the hidden terms.
std::string model_text(const Case& c, bool truth) {
    const System& s = *c.system;
    const std::vector<Effect>& hidden = c.machine.effects;
    std::string out = fmt::format("name = \"{}\"\nsummary = \"{}\"\n\n[sampling]\nperiod = \"{}\"\n\n[signals]\n", c.name,
                                  s.summary, s.period);
    for (std::size_t i = 0; i < s.signals.size(); ++i) {
        const Signal& sig = s.signals[i];
        if (sig.input >= 0) {
            out += fmt::format("{} = {{ unit = \"{}\", hold = \"zoh\" }}\n", sig.name, sig.unit);
        } else {
            out += fmt::format("{} = {{ unit = \"{}\", noise = {}, resolution = {}, initial = {}{} }}\n", sig.name, sig.unit,
                               c.noise[i], c.resolution[i], number(s.initial[static_cast<std::size_t>(sig.state)]),
                               sig.scored ? "" : ", scored = false");
        }
    }
    if (truth) {
        for (std::size_t e = 0; e < hidden.size(); ++e) {
            for (const std::string& line : hidden[e].own_signals) out += own(line, e) + "\n";
        }
    }
    out += "\n[constants]\n";
    for (std::size_t q = 0; q < s.quantities.size(); ++q) {
        const double value = truth ? c.machine.p[q] : c.believed[q];
        if (s.quantities[q].known)
            out +=
                fmt::format("{} = {{ value = {}{} }}\n", s.quantities[q].name, number(value), unit_of(s.quantities[q].unit));
    }
    if (truth) {
        for (std::size_t e = 0; e < hidden.size(); ++e) {
            for (std::size_t n = 0; n < hidden[e].names.size(); ++n) {
                out +=
                    fmt::format("{} = {{ value = {} }}\n", own("x_" + hidden[e].names[n], e), number(hidden[e].values[n]));
            }
        }
    }
    out += "\n[parameters]\n";
    for (std::size_t q = 0; q < s.quantities.size(); ++q) {
        const Quantity& quantity = s.quantities[q];
        if (quantity.known) continue;
        out += fmt::format("{} = {{ initial = {}{}, min = 0.0, max = {} }}\n", quantity.name,
                           number(truth ? quantity.value : c.initial_guess[q]), unit_of(quantity.unit),
                           number(rounded(20 * quantity.value, 2)));
    }
    for (std::size_t e = 0; e < s.equations.size(); ++e) {
        std::string ode = s.equations[e].ode;
        for (std::size_t h = 0; truth && h < hidden.size(); ++h) {
            for (std::size_t w = 0; w < hidden[h].input_texts.size(); ++w) {
                ode = with_word(ode, s.inputs[static_cast<std::size_t>(hidden[h].inputs[w])],
                                own(hidden[h].input_texts[w], h));
            }
        }
        if (truth) {
            for (std::size_t h = 0; h < hidden.size(); ++h) {
                for (std::size_t w = 0; w < hidden[h].slots.size(); ++w) {
                    const Slot& slot = s.slots[static_cast<std::size_t>(hidden[h].slots[w])];
                    const std::string text = own(hidden[h].texts[w], h);  // begins with a sign
                    if (slot.equation == static_cast<int>(e)) ode += " " + text;
                    if (slot.opposite == static_cast<int>(e)) ode += " - (0" + text + ")";
                }
            }
        }
        out += fmt::format("\n[[equation]]\nname = \"{}\"\node = \"{}\"\n", s.equations[e].name, ode);
    }
    if (truth) {
        int count = 0;
        for (std::size_t e = 0; e < hidden.size(); ++e) {
            for (const std::string& line : hidden[e].own_equations) {
                out += fmt::format("\n[[equation]]\nname = \"hidden {}\"\node = \"{}\"\n", ++count, own(line, e));
            }
        }
    }
    if (s.feedback) {
        out += fmt::format(
            "\n[[feedback]]              # closes the loop in simulation: sampled every period, held, instead of replaying "
            "the recorded "
            "signal\nsignal = \"{}\"\nlaw = \"{}\"\n",
            s.inputs[static_cast<std::size_t>(s.feedback->input)], s.feedback->law);
    }
    return out;
}

ordered_json answer(const Case& c) {
    const System& s = *c.system;
    // The recording is cut as a person would: at a tenth of its last digit.
    const double train = rounded(0.7 * s.duration, 6);
    bool unknown = false;
    ordered_json effects = ordered_json::array(), accepted = ordered_json::array();
    for (const Effect& e : c.machine.effects) {
        ordered_json values;
        if (e.stated) {
            for (const auto& [name, value] : e.stated(e.values)) values[name] = value;
        } else {
            for (std::size_t n = 0; n < e.names.size(); ++n) values[e.names[n]] = e.values[n];
        }
        effects.push_back({{"name", e.name}, {"equation", e.equations(s)}, {"formula", e.formula}, {"params", values}});
        accepted.push_back(e.accepted);
        unknown = unknown || !e.in_library;
    }
    ordered_json parameters = ordered_json::object(), wrong = ordered_json::object(), floor, nominal, refitted;
    for (std::size_t q = 0; q < s.quantities.size(); ++q) {
        const std::string& name = s.quantities[q].name;
        parameters[name] = c.machine.p[q];
        if (c.believed[q] == c.machine.p[q]) continue;
        wrong[name] = rounded(c.believed[q] / c.machine.p[q], 5);
        if (c.ambiguous) continue;
        effects.push_back({{"name", "parameter_error"},
                           {"equation", name},
                           {"formula", "the value declared known is wrong"},
                           {"params", ordered_json::object()}});
        accepted.push_back({"parameter_error"});
    }
    std::size_t o = 0;
    for (const Signal& sig : s.signals) {
        if (sig.state < 0 || !sig.scored) continue;
        floor[sig.name] = rounded(c.floor[o], 4);
        nominal[sig.name] = rounded(c.nominal[o], 4);
        refitted[sig.name] = rounded(c.refitted[o++], 4);
    }
    const std::string verdict = c.ambiguous ? "ambiguous" : effects.empty() ? "none" : unknown ? "unknown" : "named";
    return {{"case", c.name},
            {"train_s", {0.0, train}},
            {"test_s", {train, s.duration}},
            {"verdict", verdict},
            {"effects", effects},
            {"accepted_names", accepted},
            {"may_stay_ambiguous", c.rivals},
            {"equal_terms", c.equal_terms},
            {"true_model_parameters", parameters},
            {"noise_floor_nrmse", floor},
            {"nominal_nrmse_with_true_parameters", nominal},
            {"wrong_known_parameters", wrong},
            {"regularisation", fmt::format("sgn(x) is tanh(x/eps), eps={} of the size of x", smoothing)},
            {"note", c.note},
            {"hidden", c.hidden},
            {"refitted_nominal_nrmse", refitted}};
}

std::string recording(const System& system, const std::vector<std::vector<double>>& columns) {
    std::string csv = "t [s]";
    for (const Signal& s : system.signals) csv += fmt::format(",{} [{}]", s.name, s.unit == "1" ? "-" : s.unit);
    csv += "\n";
    for (std::size_t k = 0; k < columns[0].size(); ++k) {
        csv += fmt::format("{:.9g}", static_cast<double>(k) * system.period);
        for (const auto& column : columns) csv += fmt::format(",{:.9g}", column[k]);
        csv += "\n";
    }
    return csv;
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

void write_case(const Case& c, const std::string& folder) {
    const std::filesystem::path path(folder);
    std::filesystem::create_directories(path);
    write(path / "model.toml", model_text(c, false));
    write(path / "truth.toml", model_text(c, true));
    write(path / "answer.json", answer(c).dump(1) + "\n");
    write(path / "measured.csv", recording(*c.system, c.measured));
    if (!c.unspoilt.empty()) write(path / "truth.csv", recording(*c.system, c.unspoilt));
}

}  // namespace algest::gap
