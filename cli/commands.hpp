// SPDX-License-Identifier: GPL-3.0-or-later
// The subcommands: what each is told, and the exit code that it answers with.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "lab/recording.hpp"
#include "lab/stretch.hpp"

namespace algest::cli {

struct CheckOptions {
    std::vector<std::string> models;
    bool strict = false;
    bool identifiability = false;      ///< the structural verdict of every parameter instead of an estimator's soundness
    std::vector<std::string> hidden;   ///< signals that nobody measures
    bool json = false;
};
/// Are the models sound and identifiable? 0: all; 1: one is not identifiable; 2: one is not sound.
/// JSON: {"models": [{"model", "ok", "warnings"}]}, after an error with "error": [...] in front; with `identifiability` each sound model has
/// "identifiability": what cli/identifiability.hpp says.
int check(const CheckOptions& options);

struct KeysOptions {
    std::string format = "text";  ///< text, markdown (the tables of docs/model-file.md), json
};
/// Prints what may stand in a model file. JSON: {"sections": [{"heading", "keys": [{"name", "unit", "default" (TOML; words in parentheses; or ""),
/// "meaning", "page" (of docs/)}]}]}.
int keys(const KeysOptions& options);

struct DeriveOptions {
    std::string model;
    std::string format = "text";  ///< text, latex, json
    bool weights = false;         ///< json: the tables too
};
/// Prints the derivation of the estimator.
int derive(const DeriveOptions& options);

struct GenerateOptions {
    std::vector<std::string> models;
    std::string directory = "generated";
    std::string scalar = "double";  ///< double, float
    std::string engine;             ///< fir, moments; empty: as the model says
    bool check = false;             ///< write nothing, show the difference
    bool json = false;
};
/// Writes the estimators, DIR/NAME/..., or compares them with what is there (1: they differ). A model that fails leaves
/// nothing; the others are written. JSON: {"models": [{"model", "name", "written": [path], "cost": [{"engine", "operations" (a sample,
/// floating-point, besides solve and formulas), "memory", "tables" (bytes)}] (the chosen engine's, then the other's)}]}, with --check
/// {"models": [{"model", "name", "differences": [{"path", "difference"}]}]}; after an error with "error": [...] in front,
/// and with the models that did not fail.
int generate(const GenerateOptions& options);

struct ReplayOptions {
    std::string model;
    std::vector<std::string> recordings;   ///< one at least
    std::string output;          ///< CSV of every sample; empty: none
    std::string report;          ///< HTML page; empty: none
    std::vector<std::string> command;   ///< as typed, without the program's name
    std::string scalar = "double";  ///< double, float: as the estimator on the target
    std::optional<double> from;  ///< s
    std::optional<double> to;
    bool batch = false;          ///< all rows at once
    int jobs = 0;                ///< of several recordings at once; 0: as many as there are processors
    lab::CsvStyle csv;
    bool json = false;
};
/// Runs the estimator over the recording and prints the parameters.
int replay(const ReplayOptions& options);
/// The scalar in which the estimator computes.
plan::Scalar scalar_of(const ReplayOptions& options);
/// The same over several recordings, a line each; those without an estimate and those that fail come last. 2: one failed. JSON: {"model",
/// "recordings": [one object each, as of one recording, or {"recording", "error": [...]}]}, in the same order.
int replay_several(const ReplayOptions& options, const lab::Stretch& stretch);
/// The same with all rows at once, where rows hold at single instants. 1: the recording does not determine all parameters. JSON: {"model",
/// "recording", "samples", "uniform", "instants", "parameters": [{"name", "unit", "value", "sd"}], "condition", "correlated_instants",
/// "confused": [{"unknowns", "hardly", "text"}]}.
int replay_batch(const ReplayOptions& options, const lab::Stretch& stretch);

struct DesignOptions {
    std::string model;
    std::string recording;
    std::optional<double> accuracy;   ///< relative error that is wanted
    lab::CsvStyle csv;
    bool json = false;
};
/// Tries windows, kappa and rows on the recording and recommends. 1: the accuracy is out of reach, or nothing is determined. JSON: {"model", "recording",
/// "reference": {"free_run", "parameters": [{"name", "unit", "value", "counts"}]}, "accuracy", "reached", "recommended": TRIAL, "curve": [TRIAL], "others": [TRIAL],
/// "missing": [text]}, TRIAL {"window_s", "kappa": [by equation], "rows": [[p]], "engine", "multiply_adds", "ok", "noise", "perturbation", "error",
/// "parameters": [{"name", "mean", "scatter"}]}.
int design(const DesignOptions& options);

struct SimulateOptions {
    std::string model;
    std::string recording;
    std::string output;             ///< CSV of every simulated signal; empty: none
    std::string report;             ///< HTML page; empty: none
    std::vector<std::string> command;   ///< as typed, without the program's name
    std::vector<std::string> set;   ///< NAME=VALUE in place of a parameter's initial value
    lab::CsvStyle csv;
    bool json = false;
};
/// Runs the model freely over the inputs of the recording and says how far it is from what was measured. 1: the run diverged.
int simulate(const SimulateOptions& options);

struct DiscoverOptions {
    std::string model;
    std::vector<std::string> recordings;   ///< of one machine
    std::string directory;       ///< for the amended model, its patch and the free runs before and after
    std::string train;           ///< "A:B" in s, of each recording; empty: the first 70 percent
    std::string test;            ///< "C:D" in s; empty: the rest
    bool apply = false;          ///< write the amended text over the model file
    lab::CsvStyle csv;
    bool json = false;
};
/// Finds where model and recordings disagree and names the missing effect.
int discover(const DiscoverOptions& options);

}  // namespace algest::cli
