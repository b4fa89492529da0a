// SPDX-License-Identifier: GPL-3.0-or-later
// algest: parses the command line, calls a command, prints what went wrong.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <string>
#include <tuple>
#include <vector>

#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "generator/suggestion.hpp"

namespace {

using namespace algest::cli;

constexpr const char* json_text = "one JSON object on standard output, for programs";

CLI::App* add_check(CLI::App& app, CheckOptions& options) {
    CLI::App* command = app.add_subcommand("check", "Are the models sound and identifiable?");
    command->add_option("MODEL", options.models, "model files")->required();
    command->add_flag("--strict", options.strict, "a quantity without unit is an error");
    CLI::Option* const structural = command->add_flag("--identifiability", options.identifiability, "which parameters perfect measurements determine: globally, locally or not, and then which combination");
    command->add_option("--hidden", options.hidden, "signals that nobody measures; with --identifiability")->type_name("NAME,...")->delimiter(',')->allow_extra_args(false)->needs(structural);
    command->add_flag("--json", options.json, json_text);
    command->footer(
        "Exit code: 0 all are, 1 one is not identifiable, 2 one is not sound.\n\n"
        "Examples:\n"
        "  algest check models/rl_circuit.toml\n"
        "  algest check models/motor_pump.toml --identifiability --hidden P_0\n"
        "  algest check models/*.toml --strict");
    return command;
}

CLI::App* add_keys(CLI::App& app, KeysOptions& options) {
    CLI::App* command = app.add_subcommand("keys", "What may stand in a model file: every key, its unit, default and meaning");
    command->add_option("--format", options.format, "text, markdown or json")
        ->check(CLI::IsMember({"text", "markdown", "json"}))
        ->capture_default_str();
    command->add_flag_callback(
        "--json", [&options] { options.format = "json"; }, "the same as --format json");
    command->footer(
        "Examples:\n"
        "  algest keys\n"
        "  algest keys --json");
    return command;
}

CLI::App* add_derive(CLI::App& app, DeriveOptions& options) {
    CLI::App* command = app.add_subcommand("derive", "Shows how the estimator of a model follows from it");
    command->add_option("MODEL", options.model, "model file")->required();
    command->add_option("--format", options.format, "text, latex or json")
        ->check(CLI::IsMember({"text", "latex", "json"}))
        ->capture_default_str();
    command->add_flag_callback(
        "--json", [&options] { options.format = "json"; }, "the same as --format json");
    command->add_flag("--weights", options.weights, "json: the weights of every kernel too");
    command->footer(
        "Examples:\n"
        "  algest derive models/rl_circuit.toml\n"
        "  algest derive models/dc_motor.toml --format latex > build/dc_motor.tex\n"
        "  algest derive models/dc_motor.toml --format json --weights");
    return command;
}

CLI::App* add_generate(CLI::App& app, GenerateOptions& options) {
    CLI::App* command = app.add_subcommand("generate", "Writes the estimators of models as C++, or checks what is there");
    command->add_option("MODEL", options.models, "model files")->required();
    command->add_option("-o,--output", options.directory, "folder to write into")->type_name("DIR")->capture_default_str();
    command->add_option("--scalar", options.scalar, "double or float")
        ->check(CLI::IsMember({"double", "float"}))
        ->capture_default_str();
    command->add_option("--engine", options.engine, "fir or moments; default: as the model says")
        ->check(CLI::IsMember({"fir", "moments"}));
    command->add_flag("--check", options.check, "write nothing; print the difference from what is there");
    command->add_flag("--json", options.json, json_text);
    command->footer(
        "Exit code: 0 done, 1 --check found a difference, 2 a model or a file is at fault.\n\n"
        "Examples:\n"
        "  algest generate models/rl_circuit.toml -o build/estimators\n"
        "  algest generate models/pmsm_electrical.toml -o build/estimators --scalar float\n"
        "  algest generate models/*.toml --check");
    return command;
}

/// How a text file is written, where it is not as design.md has it.
void add_csv_style(CLI::App& command, algest::lab::CsvStyle& style) {
    CLI::Option* const separator = command.add_option_function<std::string>("--separator", [&style](const std::string& name) {
        style.separator = name == "semicolon" ? ';' : name == "tab" ? '\t' : ',';
    }, "between the columns of a CSV file: comma, semicolon or tab; default: comma")->check(CLI::IsMember({"comma", "semicolon", "tab"}))->type_name("NAME");
    command.add_flag_callback("--decimal-comma", [&style, separator] {
        style.decimal = ',';
        if (separator->count() == 0) style.separator = ';';
    }, "numbers of a CSV file are written 1,5; columns are then separated by semicolons, unless --separator tab");
}

constexpr const char* report_text = "write a page with figures, tables and the mathematics, to be read in a browser or on paper";
constexpr const char* recording_text = "CSV file (.gz too) with a header `name [unit]` and a column `t [s]`, or a MATLAB file (.mat) with a vector t";

CLI::App* add_replay(CLI::App& app, ReplayOptions& options) {
    CLI::App* command = app.add_subcommand("replay", "Runs the estimator of a model over a recording");
    command->add_option("MODEL", options.model, "model file")->required();
    command->add_option("RECORDING", options.recordings, std::string(recording_text) + "; several: a line each, failures last")
        ->required();
    command->add_option("-o,--output", options.output, "write status, condition and parameters of every sample")
        ->type_name("FILE.csv");
    command->add_option("--report", options.report, report_text)->type_name("FILE.html");
    command->add_option("--jobs", options.jobs, "recordings replayed at once, where there are several; default: as many as there are processors")
        ->type_name("N")
        ->check(CLI::Range(1, 1000));
    command->add_option("--scalar", options.scalar, "double or float, as the estimator on the target")
        ->check(CLI::IsMember({"double", "float"}))
        ->capture_default_str();
    command->add_option("--from", options.from, "start at this instant of the recording")->type_name("SECONDS");
    command->add_option("--to", options.to, "end at this instant")->type_name("SECONDS");
    command->add_flag("--batch", options.batch, "all rows at once, for functional = \"derivative\": any increasing `t`, first and last sample too");
    add_csv_style(*command, options.csv);
    command->add_flag("--json", options.json, json_text);
    command->footer(
        "Examples:\n"
        "  algest replay models/rl_circuit.toml examples/rl_circuit/recording.csv\n"
        "  algest replay models/rl_circuit.toml examples/rl_circuit/recording.csv --from 0.03 --to 0.1 -o build/estimates.csv\n"
        "  algest replay models/rl_circuit.toml examples/rl_circuit/recording.csv --json\n"
        "  algest replay models/rl_circuit.toml examples/rl_circuit/recording.csv --report build/coil.html\n"
        "  algest replay models/rl_circuit.toml examples/rl_circuit/*.csv --jobs 4\n"
        "  algest replay examples/rl_circuit/derivative.toml examples/rl_circuit/recording.csv --batch\n\n"
        "Exit code: 0 done, 1 --batch found parameters that the recording does not determine, 2 a model or a file is at fault.");
    return command;
}

CLI::App* add_design(CLI::App& app, DesignOptions& options) {
    CLI::App* command = app.add_subcommand("design", "Which window, rows, kappa and engine suit a recording");
    command->add_option("MODEL", options.model, "model file; its window may be left out")->required();
    command->add_option("RECORDING", options.recording, recording_text)->required();
    command->add_option("--accuracy", options.accuracy, "relative error that is wanted, e.g. 0.02: the shortest window that has it; default: the least error")->type_name("SHARE")->check([](const std::string& text) {
        double share = 0;
        return CLI::detail::lexical_cast(text, share) && share > 0 && share < 1 ? std::string() : text + " is not a share between 0 and 1; write 0.05 for 5 percent";
    });
    add_csv_style(*command, options.csv);
    command->add_flag("--json", options.json, json_text);
    command->footer(
        "Exit code: 0 done, 1 the accuracy is out of reach or the recording determines nothing, 2 a model or a file is at fault.\n\n"
        "Examples:\n"
        "  algest design models/rl_circuit.toml examples/rl_circuit/recording.csv\n"
        "  algest design models/rl_circuit.toml examples/rl_circuit/recording.csv --accuracy 0.05 --json");
    return command;
}

CLI::App* add_simulate(CLI::App& app, SimulateOptions& options) {
    CLI::App* command = app.add_subcommand("simulate", "Runs a model freely over the inputs of a recording");
    command->add_option("MODEL", options.model, "model file")->required();
    command->add_option("RECORDING", options.recording, recording_text)
        ->required();
    command->add_option("-o,--output", options.output, "write every simulated signal")->type_name("FILE.csv");
    command->add_option("--report", options.report, report_text)->type_name("FILE.html");
    command->add_option("--set", options.set, "a parameter's value, in place of its `initial`")->type_name("NAME=VALUE")->allow_extra_args(false);
    add_csv_style(*command, options.csv);
    command->add_flag("--json", options.json, json_text);
    command->footer(
        "nrmse is the error's rms over max(std, 0.1 rms) of the measured signal.\n"
        "Exit code: 0 done, 1 the run diverged, 2 a model or a file is at fault.\n\n"
        "Examples:\n"
        "  algest simulate models/rl_circuit.toml examples/rl_circuit/recording.csv\n"
        "  algest simulate models/rl_circuit.toml examples/rl_circuit/recording.csv --set R=3.01 --set L=0.009 -o build/run.csv\n"
        "  algest simulate models/rl_circuit.toml examples/rl_circuit/recording.csv --set R=3.01 --set L=0.009 --report build/run.html");
    return command;
}

CLI::App* add_discover(CLI::App& app, DiscoverOptions& options) {
    CLI::App* command = app.add_subcommand("discover", "Finds what a model misses, names it and writes it into the model");
    command->add_option("MODEL", options.model, "model file")->required();
    command->add_option("RECORDING", options.recordings, std::string(recording_text) + "; several: all of one machine")
        ->required();
    command->add_option("-o,--output", options.directory, "folder for the amended model, its patch, before.csv and after.csv")
        ->type_name("DIR")
        ->required();
    command->add_option("--train", options.train, "seconds of each recording to fit and choose on; default: the first 70 percent")->type_name("A:B");
    command->add_option("--test", options.test, "seconds of each recording to score on, once; default: the rest")->type_name("C:D");
    command->add_flag("--apply", options.apply, "write what was named (no other verdict) into the model file itself");
    add_csv_style(*command, options.csv);
    command->add_flag("--json", options.json, json_text);
    command->footer(
        "Verdicts: named; ambiguous (the data allow several); none (the model explains the data); unknown (a gap, and no known\n"
        "effect explains it). Effects are read from models/effects, and from a folder `effects` beside the model.\n"
        "Exit code: 0 done, 2 a model or a file is at fault.\n\n"
        "Examples (`make demo` makes the recording; several of one machine may stand there):\n"
        "  algest discover examples/demo/motor.toml build/demo/motor.csv -o build/found\n"
        "  algest discover examples/demo/motor.toml build/demo/motor.csv -o build/found --train 0:3 --test 3:5 --json");
    return command;
}

/// What goes wrong outside any command: one line for people, the usual object for programs.
int complain(const std::string& what, const std::string& right, bool json) {
    algest::Diagnostics diagnostics;
    diagnostics.error("algest", {}, what, right);
    return fail(diagnostics, json);
}

bool is_model(const std::string& path) { return path.ends_with(".toml"); }

/// True where a model stands in the place of a recording and none in its own.
bool swapped(const std::string& model, const std::vector<std::string>& recordings) { return !is_model(model) && std::any_of(recordings.begin(), recordings.end(), is_model); }

/// The words behind `algest`; `help COMMAND`, as other tools have it, is `COMMAND --help`.
std::vector<std::string> words_of(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty() || words.front() != "help") return words;
    words.erase(words.begin());
    words.emplace_back("--help");
    return words;
}

int parse_and_run(const std::vector<std::string>& words, bool json) {
    CLI::App app{"From a model file to an on-line parameter estimator for a controller.", "algest"};
    app.set_version_flag("--version", "algest " ALGEST_VERSION, "Print the version and exit");
    app.require_subcommand(1);
    app.footer(
        "algest COMMAND --help says more, with examples; they run in the project's folder.\n\n"
        "Examples:\n"
        "  algest check models/rl_circuit.toml\n"
        "  algest generate models/rl_circuit.toml -o build/estimators\n"
        "  algest replay models/rl_circuit.toml examples/rl_circuit/recording.csv");
    CheckOptions check_options;
    KeysOptions keys_options;
    DeriveOptions derive_options;
    GenerateOptions generate_options;
    ReplayOptions replay_options;
    DesignOptions design_options;
    SimulateOptions simulate_options;
    DiscoverOptions discover_options;
    const CLI::App* check_command = add_check(app, check_options);
    const CLI::App* keys_command = add_keys(app, keys_options);
    const CLI::App* derive_command = add_derive(app, derive_options);
    const CLI::App* generate_command = add_generate(app, generate_options);
    const CLI::App* replay_command = add_replay(app, replay_options);
    const CLI::App* design_command = add_design(app, design_options);
    const CLI::App* simulate_command = add_simulate(app, simulate_options);
    const CLI::App* discover_command = add_discover(app, discover_options);
    if (!words.empty() && !words.front().starts_with('-')) {
        std::vector<std::string> known;
        for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
        if (std::find(known.begin(), known.end(), words.front()) == known.end()) {
            return complain("there is no command " + algest::quoted(words.front()), algest::did_you_mean(words.front(), known) + "`algest --help` lists what there is", json);
        }
    }
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));   // CLI11 takes the last word first
    } catch (const CLI::Success& help_or_version) {
        return app.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        const std::string command = app.get_subcommands().empty() ? "" : app.get_subcommands().front()->get_name();
        return complain(error.what(), command.empty() ? "`algest --help` lists what there is" : "`algest " + command + " --help` shows how, with examples", json);
    }
    replay_options.command = simulate_options.command = words;
    for (const auto& [command, model, recordings] : {std::tuple(replay_command, replay_options.model, replay_options.recordings), std::tuple(design_command, design_options.model, std::vector{design_options.recording}),
                                                     std::tuple(simulate_command, simulate_options.model, std::vector{simulate_options.recording}), std::tuple(discover_command, discover_options.model, discover_options.recordings)}) {
        if (command->parsed() && swapped(model, recordings)) return complain(algest::quoted(model) + " stands where the model belongs and a .toml among the recordings: they look swapped", "algest " + command->get_name() + " MODEL RECORDING", json);
    }
    if (check_command->parsed()) return check(check_options);
    if (keys_command->parsed()) return keys(keys_options);
    if (derive_command->parsed()) return derive(derive_options);
    if (generate_command->parsed()) return generate(generate_options);
    if (replay_command->parsed()) return replay(replay_options);
    if (design_command->parsed()) return design(design_options);
    if (simulate_command->parsed()) return simulate(simulate_options);
    if (discover_command->parsed()) return discover(discover_options);
    return exit_bad_input;
}

}  // namespace

int main(int argc, char** argv) {
    bool json = false;
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k];
        json = json || word == "--json" || word == "--format=json" || (word == "json" && std::string(argv[k - 1]) == "--format");
    }
    int code = exit_bad_input;
    try {
        code = parse_and_run(words_of(argc, argv), json);
    } catch (const std::bad_alloc&) {
        complain("out of memory", "a smaller model or recording", json);
    } catch (const std::exception& error) {
        complain(std::string("a fault of algest itself: ") + error.what(), "please report it with the files it was given",
                 json);
    } catch (...) {
        complain("a fault of algest itself", "please report it with the files it was given", json);
    }
    if (output_failed()) {
        note("algest: error: standard output could not be written");
        return exit_bad_input;
    }
    return code;
}
