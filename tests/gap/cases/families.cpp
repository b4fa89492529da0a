// SPDX-License-Identifier: GPL-3.0-or-later
#include "families.hpp"

#include <map>
#include <memory>
#include <stdexcept>

namespace algest::gap {

namespace {

using Builder = std::function<System(const Wish&, Random&)>;

const std::vector<std::pair<std::string, Builder>>& table() {
    static const std::vector<std::pair<std::string, Builder>> all = {
        {"dc", [](const Wish& w, Random& r) { return dc_motor(w, r, false); }},
        {"dca", [](const Wish& w, Random& r) { return dc_motor(w, r, true); }},
        {"pm", pmsm},
        {"mb", magnetic_bearing},
        {"tm", two_mass},
        {"msx", [](const Wish& w, Random& r) { return mass_spring(w, r, false); }},
        {"msv", [](const Wish& w, Random& r) { return mass_spring(w, r, true); }},
        {"hp", pump},
        {"arm", arm},
        {"th1", [](const Wish& w, Random& r) { return thermal(w, r, 1); }},
        {"th2", [](const Wish& w, Random& r) { return thermal(w, r, 2); }},
        {"tank", tanks},
        {"vc", voice_coil},
        {"rl", bridge_load},
        {"car", quarter_car},
        {"axis", servo_axis},
    };
    return all;
}

}  // namespace

std::vector<std::string> families() {
    std::vector<std::string> names;
    for (const auto& [name, builder] : table()) names.push_back(name);
    return names;
}

System build(const std::string& family, const Wish& wish, Random& random) {
    for (const auto& [name, builder] : table()) {
        if (name != family) continue;
        System system = builder(wish, random);
        system.family = family;
        return system;
    }
    throw std::invalid_argument("no family " + family);
}

std::function<Controller()> play(std::vector<std::vector<double>> table) {
    const auto shared = std::make_shared<const std::vector<std::vector<double>>>(std::move(table));
    return [shared] {
        return [shared](std::size_t k, const State&, std::vector<double>& u) {
            for (std::size_t i = 0; i < shared->size(); ++i) u[i] = (*shared)[i][k];
        };
    };
}

}  // namespace algest::gap
