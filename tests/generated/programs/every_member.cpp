// SPDX-License-Identifier: GPL-3.0-or-later
// Calls every member of one generated class, and nothing else: what such an object needs of the rest of the program can be
// read off its symbols.
#include HEADER

#include "uncertainty_status.hpp"

using Class = algest::generated::MODEL;

extern Class estimator;
Class estimator;

Class::Estimate all(const Class::Sample& sample, int what);
Class::Estimate all(const Class::Sample& sample, int what) {
    if (what == 0) estimator.reset();
    if (what == 1) estimator.push(sample);
    if (what == 2) return estimator.estimate();
    return estimator.step(sample);
}

algest::Status uncertain_status();
algest::Status uncertain_status() { return generated_test::uncertainty_status(estimator); }

const char* status(const Class::Estimate& e);
const char* status(const Class::Estimate& e) { return algest::name(e.status); }

void copy(const Class& from, Class& to);
void copy(const Class& from, Class& to) { to = from; }
