// SPDX-License-Identifier: 0BSD
// Feeds a recording of a linear axis to its generated estimator, sample by sample, as the axis's controller would.
//   axis RECORDING.csv ESTIMATES.csv
// The recording has the columns `qm [m]` and `force [N]` at 1 ms; the estimates are written one line a sample.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <positioning_axis/positioning_axis.hpp>

namespace {

std::vector<std::string> fields(const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) out.push_back(field);
    return out;
}

int column(const std::vector<std::string>& header, const std::string& name) {
    for (std::size_t k = 0; k < header.size(); ++k) {
        if (header[k].rfind(name, 0) == 0) return static_cast<int>(k);
    }
    std::cerr << "no column " << name << "\n";
    std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: axis RECORDING.csv ESTIMATES.csv\n";
        return 2;
    }
    std::ifstream recording(argv[1]);
    std::ofstream estimates(argv[2]);
    std::string line;
    if (!std::getline(recording, line) || !estimates) {
        std::cerr << "cannot read " << argv[1] << " or write " << argv[2] << "\n";
        return 2;
    }
    const std::vector<std::string> header = fields(line);
    const std::size_t t = static_cast<std::size_t>(column(header, "t "));
    const std::size_t q = static_cast<std::size_t>(column(header, "qm "));
    const std::size_t force = static_cast<std::size_t>(column(header, "force "));

    // What a controller needs: one object, one sample a period, one answer.
    algest::generated::PositioningAxis estimator;
    algest::generated::PositioningAxis::Estimate estimate{};
    estimates << "t [s],status,M [kg],Fv [N.s/m],Fc [N],offset [N]\n";
    while (std::getline(recording, line)) {
        const std::vector<std::string> value = fields(line);
        algest::generated::PositioningAxis::Sample sample{};
        sample.q = std::stod(value.at(q));
        sample.force = std::stod(value.at(force));
        estimate = estimator.step(sample);
        if (estimate.status == algest::Status::ok) {
            estimates << value.at(t) << ",ok," << estimate.M << ',' << estimate.Fv << ',' << estimate.Fc << ',' << estimate.offset << '\n';
        }
    }

    std::printf("parameter      estimate   published   unit\n");
    std::printf("M              %8.2f       95.11   kg\n", estimate.M);
    std::printf("Fv             %8.2f      203.5    N.s/m\n", estimate.Fv);
    std::printf("Fc             %8.2f       20.39   N\n", estimate.Fc);
    std::printf("offset         %8.2f       -3.16   N\n", estimate.offset);
    std::printf("status of the last sample: %s, condition %.1f\n", algest::name(estimate.status), estimate.condition);
    return estimate.status == algest::Status::ok ? 0 : 1;
}
