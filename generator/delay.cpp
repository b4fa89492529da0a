// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/delay.hpp"

#include <algorithm>

#include "generator/constant_value.hpp"

namespace algest::model {

void add_delays(const Model& model, const formula::Formula& f, std::vector<Delay>& out) {
    for (const formula::Formula& a : f->arguments) add_delays(model, a, out);
    if (!formula::is_call(f, "delay")) return;
    const std::string text = formula::text(f);
    if (std::any_of(out.begin(), out.end(), [&](const Delay& d) { return d.text == text; })) return;
    const auto value = constant_value(model, f->arguments[1]);
    out.push_back({text, f, model.signal_index(f->arguments[0]->name), value, value ? -1 : model.parameter_index(f->arguments[1]->name)});
}

}  // namespace algest::model
