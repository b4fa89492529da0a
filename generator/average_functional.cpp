// SPDX-License-Identifier: GPL-3.0-or-later
// functional = "average" (002): a row holds for the means of a steady state. They are averaged before products are made of them, so that a window
// is one sample with the weight 1.
#include "generator/row_functional.hpp"

namespace algest::generator {

namespace {

using exact::Rational;

class AverageFunctional : public RowFunctional {
public:
    plan::Functional kind() const override { return plan::Functional::average; }
    int intervals() const override { return 0; }
    bool weights_differentiate() const override { return false; }
    kernel::Coefficients kernel(std::size_t, int, Kind) override { return {1}; }
    std::string table_name(std::size_t, int, Kind, plan::Hold) const override { return "mean"; }
    std::vector<double> weights(std::size_t, int, Kind, plan::Hold) override { return {1.0}; }
    Rational of_one(std::size_t, int, Kind) override { return 1; }
    Rational time_scale(int) const override { return 1; }
    Rational square_norm(std::size_t, int) override { return 1; }
    Rational noise_gain(int) const override { return 1; }
    std::vector<plan::Annihilated> annihilated(std::size_t, const std::vector<ChosenRow>&) const override { return {}; }
};

}  // namespace

std::unique_ptr<RowFunctional> average_functional() { return std::make_unique<AverageFunctional>(); }

}  // namespace algest::generator
