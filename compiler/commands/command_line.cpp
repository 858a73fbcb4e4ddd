#include "compiler/commands/command_line.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <type_traits>
#include <variant>

#include "compiler/commands/command.h"
#include "compiler/commands/files.h"
#include "compiler/workarounds.h"

namespace rg::commands {
namespace {

using Run = std::function<int()>;  // set while the words are read, called afterwards

// $RGC_CACHE, where `off` means none, else the cache folder of the user; none where there is no home.
std::string default_cache_folder() {
  const auto variable = [](const char* name) { return std::getenv(name) ? std::string(std::getenv(name)) : std::string(); };
  const std::string own = variable("RGC_CACHE"), xdg = variable("XDG_CACHE_HOME"), home = variable("HOME");
  if (!own.empty()) return own == "off" ? "" : own;
  if (!xdg.empty()) return xdg + "/rgc";
  return home.empty() ? "" : home + "/.cache/rgc";
}

// Options of commands that compile shaders.
void add_shader_options(CLI::App& command, compiler::CompileOptions& options) {
  options.cache_folder = default_cache_folder();
  command.add_option("--cache", options.cache_folder, "keep compiled shaders there; default: $RGC_CACHE, or the user's cache folder")
      ->type_name("DIR");
  command.add_flag_callback(
      "--no-cache", [&options] { options.cache_folder.clear(); }, "compile every shader anew");
  command
      .add_option_function<uint64_t>(
          "--cache-limit", [&options](uint64_t mib) { options.cache_bytes = mib << 20; }, "size beyond which the oldest entries go; default: 512")
      ->type_name("MIB")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 20));
  command.add_option("--jobs", options.workers, "threads that compile shaders; default: one a core")->type_name("N")->check(CLI::Range(1u, 1024u));
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Says what was given, what is allowed and what may have been meant; the word becomes its number, which is what CLI11 makes enums of.
template <class T>
CLI::Validator one_of(std::vector<std::pair<std::string, T>> words) {
  CLI::Validator validator("");
  validator.operation([words = std::move(words)](std::string& word) {
    std::vector<std::string> names;
    for (const auto& [name, value] : words) {
      if (name == word) {
        if constexpr (!std::is_same_v<T, std::monostate>) word = std::to_string(static_cast<int64_t>(value));
        return std::string();
      }
      names.push_back(name);
    }
    const auto meant = nearest(word, names);
    return "`" + word + "` is none of " + joined(names) + (meant ? "; did you mean `" + *meant + "`?" : "");
  });
  return validator;
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  std::vector<std::pair<std::string, std::monostate>> words;
  std::string list;
  for (const std::string& name : names) {
    words.emplace_back(name, std::monostate());
    list += (list.empty() ? "{" : ",") + name;
  }
  return one_of(std::move(words)).description(list + "}");
}

// Each alone switches off everything, with `=NAME,...` only what is named.
void add_switches(CLI::App& command, compiler::PlanOptions& plan) {
  const auto off = [&](const char* flag, bool& everything, std::set<std::string>& names, const char* help) {
    const auto values = std::make_shared<std::vector<std::string>>();
    command.add_flag(flag, *values, help)->type_name("[=NAME,...]")->delimiter(',')->each([&everything, &names, values](const std::string& value) {
      if (value == "true")
        everything = false;
      else
        names.insert(value);
    });
  };
  off("--no-aliasing", plan.aliasing, plan.no_aliasing, "memory of its own for every resource");
  off("--no-async", plan.async, plan.no_async, "one queue; a named pass stays on the first");
  off("--no-reorder", plan.reorder, plan.no_reorder, "passes in the order written; a named pass keeps its place");
  off("--no-merge", plan.merge, plan.no_merge, "a barrier group before every pass, every rendering of its own");
  off("--no-discard", plan.discard, plan.no_discard, "all old contents kept, loaded and stored");
  off("--no-fold", plan.fold, plan.no_fold, "passes that clear or resolve stay passes of their own");
  off("--no-split", plan.split, plan.no_split, "no events, whatever the target asks for");
  command
      .add_option_function<std::string>(
          "--workaround", [&plan](const std::string& name) { compiler::apply_workaround(plan, name); },
          "the switches that a driver needs: " + joined(compiler::workaround_names()))
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->check(one_of(compiler::workaround_names()).description(""));
}

constexpr size_t kMostQueues = 16;

void add_queues(CLI::App& command, std::vector<dsl::QueueKind>& queues) {
  command
      .add_option_function<std::vector<dsl::QueueKind>>(
          "--queues",
          [&queues](const std::vector<dsl::QueueKind>& given) {
            if (given.size() > kMostQueues)
              throw CLI::ValidationError("--queues",
                                         std::to_string(given.size()) + " queues are too many; the limit is " + std::to_string(kMostQueues));
            queues = given;
          },
          "what the plan may use, graphics first; default: graphics")
      ->type_name("KIND,...")
      ->delimiter(',')
      ->transform(one_of<dsl::QueueKind>(
          {{"graphics", dsl::QueueKind::graphics}, {"compute", dsl::QueueKind::compute}, {"transfer", dsl::QueueKind::transfer}}));
}

// Says what is wrong, if anything.
std::string read_warning(const std::string& code, std::vector<dsl::DiagnosticKind>& kinds) {
  const auto kind = dsl::kind_of_code(code);
  if (!kind) return "`" + code + "` is no code; `rgc explain --list` lists them";
  if (dsl::row(*kind).severity != dsl::Severity::warning) return "`" + code + "` is no warning";
  kinds.push_back(*kind);
  return "";
}

void add_warning_options(CLI::App& command, dsl::WarningPolicy& policy) {
  const auto add = [&](const char* name, std::vector<dsl::DiagnosticKind>& kinds, const char* help) {
    const auto read = [&kinds, name](const std::vector<std::string>& codes) {
      for (const std::string& code : codes)
        if (const std::string why = read_warning(code, kinds); !why.empty()) throw CLI::ValidationError(name, why);
    };
    command.add_option_function<std::vector<std::string>>(name, read, help)->type_name("CODE")->allow_extra_args(false);
  };
  add("--allow", policy.allowed, "say nothing of a warning, such as RG0516; `allow RG0516` in the file says so of one place");
  add("--deny", policy.denied, "take a warning for an error, but where the file allows it");
}

// Options that change the plan.
void add_plan_options(CLI::App& command, compiler::CompileOptions& options) {
  add_warning_options(command, options.warnings);
  command.add_option("-D", options.fixed_features, "fix a feature at build time")->type_name("NAME=VALUE")->allow_extra_args(false);
  add_switches(command, options.plan);
  command.add_flag_callback(
      "--no-fuse", [&options] { options.fuse = false; }, "every block is a kernel of its own, whatever `fuse` says");
  command
      .add_option_function<std::string>(
          "--halves",
          [&options](const std::string& word) { options.halves = word == "zero" ? compiler::HalfRounding::zero : compiler::HalfRounding::nearest; },
          "how images of the device round 16-bit floats: zero (default) or nearest")
      ->check(one_of({"zero", "nearest"}));
  add_queues(command, options.plan.queues);
  using compiler::Effort, compiler::Prefer;
  command.add_option("--prefer", options.plan.prefer, "balance, time, memory, barriers or order")
      ->type_name("WHAT")
      ->transform(one_of<Prefer>({{"balance", Prefer::balance},
                                  {"time", Prefer::time},
                                  {"memory", Prefer::memory},
                                  {"barriers", Prefer::barriers},
                                  {"order", Prefer::order}}));
  command.add_option("--effort", options.plan.effort, "of the search for an order: fast, default or max")
      ->type_name("HOW")
      ->transform(one_of<Effort>({{"fast", Effort::fast}, {"default", Effort::normal}, {"max", Effort::max}}));
  add_shader_options(command, options);
  command.add_option("--profile", options.profile, "measured times of passes, frame.profile.json; see docs/planner.md")->type_name("FILE");
}

// A subcommand that fills `Options` and then runs `work`.
template <class Options>
struct Subcommand {
  CLI::App* command;
  std::shared_ptr<Options> options = std::make_shared<Options>();

  Subcommand(CLI::App& app, Run& run, const char* name, const char* help, int (*work)(const Options&)) : command(app.add_subcommand(name, help)) {
    command->callback([options = options, work, &run] { run = [=] { return work(*options); }; });
  }
  CLI::App* operator->() const { return command; }
};

// Of text that generated files repeat in comments and rules.
CLI::Validator one_line() {
  CLI::Validator validator("");
  validator.operation([](std::string& text) { return has_controls(text) ? std::string("a control character has no place in it") : std::string(); });
  return validator;
}

constexpr const char* kRootFile = "the root .rg file";

// "3/8"; an empty text is success, as CLI11 wants it.
std::string read_shard(const std::string& text, compiler::CompileOptions& options) {
  unsigned shard = 0, shards = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%u/%u%c", &shard, &shards, &rest) != 2 || shard >= shards) return "`" + text + "` is no part such as 0/8 to 7/8";
  options.shard = shard, options.shards = shards;
  return "";
}

void add_command(CLI::App& command, compiler::CompileOptions& options) {
  command.add_option("--command", options.command, "what the banner of generated files tells to run; else `rgc build FILE`")
      ->type_name("TEXT")
      ->check(one_line());
}

void add_build(CLI::App& app, Run& run) {
  Subcommand<BuildOptions> command(app, run, "build", "compile a frame into C++ and SPIR-V; only what changed is written", build);
  BuildOptions& options = *command.options;
  command->add_option("FILE", options.file, kRootFile)->required();
  command->add_option("-o,--output", options.folder, "the folder of the generated files")->type_name("DIR")->capture_default_str()->check(one_line());
  command->add_option("--depfile", options.depfile, "write what was read as a Makefile rule")->type_name("FILE");
  command->add_option("--stamp", options.stamp, "touch this file after success; the target of the depfile")->type_name("FILE")->check(one_line());
  add_command(*command.command, options.compile);
  command->add_option("--plan-file", options.plan_file, "also write the plans as data, for programs that load them; see docs/runtime.md")
      ->type_name("FILE");
  command->add_option("--manifest", options.manifest, "list the shader variants as jobs for other machines, as JSON, and build nothing")
      ->type_name("FILE");
  command->add_option("--shard", "build only the shaders of part I of N (I from 0) into the cache, and nothing else")
      ->type_name("I/N")
      ->check([&options](const std::string& text) { return read_shard(text, options.compile); });
  command->add_flag("-q,--quiet", options.quiet, "say nothing on success");
  add_plan_options(*command.command, options.compile);
}

void add_watch(CLI::App& app, Run& run) {
  Subcommand<WatchOptions> command(app, run, "watch", "compile a frame whenever it changes, for programs that reload its plan; until interrupted",
                                   watch);
  WatchOptions& options = *command.options;
  command->add_option("FILE", options.file, kRootFile)->required();
  command->add_option("--plan-file", options.plan_file, "the file of plans that programs load; default: FILE with .rgplan")->type_name("FILE");
  command->add_option("-o,--output", options.folder, "also keep the generated files in this folder up to date")->type_name("DIR");
  add_command(*command.command, options.compile);
  command->add_flag("-q,--quiet", options.quiet, "say only what is wrong");
  add_plan_options(*command.command, options.compile);
}

void add_check(CLI::App& app, Run& run) {
  Subcommand<CheckOptions> command(app, run, "check", "diagnostics only: text, names, types, shaders, assertions", check);
  command->add_option("FILE", command.options->files, "root .rg files, each with its imports")->required();
  auto* json = command->add_flag("--json", command.options->json, "diagnostics as JSON on stdout");
  command->add_flag("--sarif", command.options->sarif, "diagnostics as SARIF 2.1.0 on stdout, for code hosts")->excludes(json);
  command->add_flag("--fix", command.options->fix, "apply the fixes that are certain, then check again");
  add_plan_options(*command.command, command.options->compile);
}

void add_fmt(CLI::App& app, Run& run) {
  Subcommand<FmtOptions> command(app, run, "fmt", "one style for .rg files", format_files);
  command->add_option("FILE", command.options->files, ".rg files")->required();
  command->add_flag("--check", command.options->check, "change nothing; fail if a file is not formatted");
}

void add_verify(CLI::App& app, Run& run) {
  Subcommand<VerifyCommand> command(app, run, "verify", "prove that the plans mean what the program says", verify_file);
  command->add_option("FILE", command.options->file, kRootFile)->required();
  command->add_flag("--mutate", command.options->mutate, "test the checker: every damaged plan must be rejected");
  command->add_flag("--long", command.options->ask_all,
                    "with --mutate: ask the abstract machine about every damaged plan that passes, not about 20 of each class");
  add_plan_options(*command.command, command.options->compile);
}

void add_explain(CLI::App& app, Run& run) {
  Subcommand<ExplainOptions> command(app, run, "explain", "why a pass, resource or barrier is as it is; what a diagnostic code means", explain);
  command->add_option("FILE|CODE", command.options->file_or_code, "the root .rg file, or a code such as RG0301");
  command->add_option(
      "NAME", command.options->name,
      "a pass, resource, struct, `group 3`, `wait 0`, `barriers`, `waits` or `schedule`; `bloom_down` also means bloom_down[0] and its siblings");
  command->add_flag("--list,--codes", command.options->codes, "list all diagnostic codes");
  add_plan_options(*command.command, command.options->compile);
}

void add_report(CLI::App& app, Run& run) {
  Subcommand<ReportOptions> command(app, run, "report", "memory, barriers, queues, variants and costs beside their bounds", report);
  command->add_option("FILE", command.options->file, kRootFile)->required();
  command->add_flag("--json", command.options->json, "the same facts as JSON; see docs/cli.md");
  add_plan_options(*command.command, command.options->compile);
}

void add_stats(CLI::App& app, Run& run) {
  Subcommand<StatsOptions> command(app, run, "stats", "what the shaders consist of, a row a variant: instructions, samples, memory, live values",
                                   stats);
  command->add_option("FILE", command.options->file, kRootFile)->required();
  command->add_flag("--json", command.options->json, "the same as JSON; see docs/variants.md");
  add_plan_options(*command.command, command.options->compile);
}

void add_spectrum(CLI::App& app, Run& run) {
  Subcommand<SpectrumCommand> command(app, run, "spectrum", "which kernels serve which tiles, what they cost, what one more would be worth",
                                      spectrum);
  SpectrumCommand& options = *command.options;
  command->add_option("FILE", options.file, kRootFile)->required();
  command->add_option("--profile", options.compile.spectrum_profile, "a recorded histogram instead of the declared one; see docs/variants.md")
      ->type_name("FILE");
  command->add_option("--modes", options.compile.spectrum_modes, "how many kernels instead of the declared number")
      ->type_name("N")
      ->check(CLI::Range(1, 32));
  command->add_option("--force", options.compile.forced_features, "a feature that every tile gets")->type_name("FEATURE")->allow_extra_args(false);
  command->add_flag("--json", options.json, "the same as JSON; see docs/variants.md");
  command->add_option("--html", options.html, "also write a page with plots")->type_name("FILE");
  command->add_option("-D", options.compile.fixed_features, "fix a feature at build time")->type_name("NAME=VALUE")->allow_extra_args(false);
  add_shader_options(*command.command, options.compile);
  add_warning_options(*command.command, options.compile.warnings);
}

void add_graph(CLI::App& app, Run& run) {
  Subcommand<GraphOptions> command(app, run, "graph", "passes and the resources between them", show_graph);
  command->add_option("FILE", command.options->file, kRootFile)->required();
  auto* dot = command->add_flag("--dot", command.options->dot, "for Graphviz");
  command
      ->add_flag("--html", command.options->html, "a page to look at: schedule, barriers, lifetimes, memory, and the reason for everything clicked")
      ->excludes(dot);
  add_plan_options(*command.command, command.options->compile);
}

void add_diff(CLI::App& app, Run& run) {
  Subcommand<DiffOptions> command(app, run, "diff", "what a change does to the plan", diff);
  command->add_option("OLD", command.options->before, "a root .rg file")->required();
  command->add_option("NEW", command.options->after, "another")->required();
  add_plan_options(*command.command, command.options->compile);
}

void add_emit(CLI::App& app, Run& run) {
  Subcommand<EmitOptions> command(app, run, "emit", "what a phase gives, as text", emit);
  command->add_option("STAGE", command.options->stage, "which phase")->required()->check(one_of(emit_stages()));
  command->add_option("FILE", command.options->file, kRootFile)->required();
  add_plan_options(*command.command, command.options->compile);
}

// CLI11 would only say that a subcommand is missing.
bool names_a_command(const CLI::App& app, const std::string& word) {
  if (word.starts_with('-')) {
    if (word == "-h" || word == "--help" || word == "--version") return true;
    std::fprintf(stderr, "rgc: there is no option `%s` before a command; what a command takes stands behind it\n", word.c_str());
    std::fprintf(stderr, "Run with --help for more information.\n");
    return false;
  }
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return true;
  const auto meant = nearest(word, names);
  std::fprintf(stderr, "rgc: there is no command `%s`%s\n", word.c_str(), meant ? ("; did you mean `" + *meant + "`?").c_str() : "");
  std::fprintf(stderr, "Run with --help for more information.\n");
  return false;
}

// `--no-aliasing=` and `--no-aliasing=a,,b`, of which CLI11 makes `--no-aliasing` and `--no-aliasing=a,b`.
bool lacks_a_name(std::string_view word) {
  const size_t equal = word.find('=');
  if (word.size() <= 3 || !word.starts_with("--") || equal == std::string_view::npos) return false;
  const std::string_view list = word.substr(equal + 1);
  return list.empty() || (word.starts_with("--no-") && (list.front() == ',' || list.back() == ',' || list.find(",,") != std::string_view::npos));
}

bool names_values(int argc, char** argv) {
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    if (!lacks_a_name(argv[i])) continue;
    std::fprintf(stderr, "rgc: a value is missing in `%s`\nRun with --help for more information.\n", argv[i]);
    return false;
  }
  return true;
}

int run_and_flush(const Run& run) {
  const int code = run();
  show_progress({});
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  std::perror("rgc: cannot write to stdout");
  return exit_input_wrong;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app{"rgc compiles a render graph: .rg files become C++ and SPIR-V.", "rgc"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "rgc 0.1.0");
  app.footer("Exit codes: 0 done, 1 the input is wrong, 2 the call is wrong, 3 our fault.");
  Run run;
  for (auto* add :
       {add_build, add_watch, add_check, add_fmt, add_verify, add_explain, add_report, add_stats, add_spectrum, add_graph, add_diff, add_emit})
    add(app, run);
  if (argc > 1 && (!names_a_command(app, argv[1]) || !names_values(argc, argv))) return exit_call_wrong;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_call_wrong;
  }
  return run_and_flush(run);
}

}  // namespace rg::commands
