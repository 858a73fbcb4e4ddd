// Private to the check_*.cpp files: what checking knows while it walks the trees.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "dsl/check.h"
#include "dsl/closest.h"
#include "dsl/format_table.h"
#include "dsl/symbolic.h"

namespace rg::dsl {

// ---- values -----------------------------------------------------------------------------------------------------

// One integer: known now, or an expression over extents.
struct Scalar64 {
  int64_t value = 0;
  ExprId expr;  // valid: known only when the program runs
  bool known() const { return !expr.valid(); }
};
struct Value {
  enum class Kind : uint8_t { error, integer, real, list } kind = Kind::error;
  uint8_t axes = 1;  // integer: 1 is a number, 2 and 3 are sizes
  Scalar64 at[3];
  double real = 0;              // also set for known integers
  std::vector<double> numbers;  // list

  bool ok() const { return kind != Kind::error; }
  bool known_integer() const { return kind == Kind::integer && axes == 1 && at[0].known(); }
  bool is_number() const { return kind == Kind::real || known_integer(); }
};

// ---- names ------------------------------------------------------------------------------------------------------

enum class SymbolKind : uint8_t { constant, extent, structure, interface, sampler, state, feature, condition, set, graph, technique, spectrum };
struct Symbol {
  SymbolKind kind = SymbolKind::constant;
  uint32_t module = 0;
  const ast::Declaration* declaration = nullptr;
  const ast::StructDeclaration* record = nullptr;  // of a struct that stands in a `per_draw`
  ast::Name name;
  enum class Progress : uint8_t { open, running, done } progress = Progress::open;
  uint32_t id = UINT32_MAX;  // row of the program's table; none after an error
  Value value;               // constants
  bool is_private = false;   // other modules do not see it
};
struct Visible {                                     // what a name means inside one module
  uint32_t symbol = UINT32_MAX, other = UINT32_MAX;  // other: a second module declares it too
};

struct NodeKey {
  ExprOp op = ExprOp::constant;
  uint32_t a = 0, b = 0;
  int64_t value = 0;
  friend bool operator==(const NodeKey&, const NodeKey&) = default;
};
struct NodeHash {
  size_t operator()(const NodeKey& key) const {
    constexpr uint64_t kMix = 0x9E3779B97F4A7C15ull;
    uint64_t hash = static_cast<uint64_t>(key.op);
    for (const uint64_t part : {uint64_t{key.a}, uint64_t{key.b}, static_cast<uint64_t>(key.value)}) hash = (hash ^ part ^ (hash >> 29)) * kMix;
    return hash;
  }
};

struct Deeper {
  uint32_t& depth;
  explicit Deeper(uint32_t& depth_) : depth(++depth_) {}
  ~Deeper() { --depth; }
};

struct Checker {
  const std::vector<Module>& modules;
  Diagnostics& diagnostics;
  Program program;
  std::vector<Symbol> symbols;
  std::vector<std::unordered_map<std::string_view, Visible>> scopes;         // by module
  std::vector<std::unordered_map<std::string_view, uint32_t>> own_names;     // by module
  std::vector<std::unordered_map<std::string_view, uint32_t>> module_names;  // by module: modules it can see
  std::vector<bool> used;                                                    // by symbol
  std::unordered_map<NodeKey, ExprId, NodeHash> nodes;                       // equal expressions are one row
  std::unordered_map<std::string, Span> public_names;                        // structs and constants: shaders and C++ see them unqualified
  std::set<std::string> unknown;                                             // "MODULE NAME" that were reported as unknown: once is enough
  bool lost_names = false;                                                   // a name that is not found may be in what did not parse
  uint32_t depth = 0;                                                        // of evaluations inside one another: bounds the stack
  std::vector<uint32_t> struct_depths;                                       // by struct: itself and the longest chain of structs inside it
  Formulas formulas{program};                                                // of what has been declared so far

  Diagnostic& report(DiagnosticKind kind, Span span, std::vector<std::string> arguments = {}) {
    return diagnostics.report(kind, span, std::move(arguments));
  }
};

// ---- places -----------------------------------------------------------------------------------------------------

struct Binding;
struct Place {  // `bloom.mip(i).layer(0)` resolved
  ResourceId resource;
  Range range;
  uint32_t age = 0;
  std::string default_name;
  Span span;
  const Binding* read_only = nullptr;  // the technique's parameter it came through, if that may only be read
  Binding* port = nullptr;             // the technique's `out` parameter it came through
  Format view = Format::none;          // `.view(FORMAT)`
  bool ok() const { return resource.valid(); }
};

struct Binding {  // of a loop variable or a technique's parameter
  std::string_view name;
  enum class Kind : uint8_t { integer, place, params } kind = Kind::integer;
  int64_t value = 0;
  Place place;
  bool writable = true;
  ParamsId params;
  Span span;
  bool is_out = false, written = false;  // an `out` parameter, and whether the technique has written it so far
};

// The graph that is being built, and where in it we are.
struct GraphScope {
  Graph graph;
  uint32_t module = 0;
  std::string prefix;             // of names inside a technique's instance
  std::vector<Binding> bindings;  // innermost last
  Guard guard;
  std::vector<ConditionId> conditions;
  FusionId fusion;  // the `fuse` around
  std::unordered_map<std::string, ResourceId> resources;
  std::unordered_map<std::string, PassId> passes;
  std::unordered_map<std::string, ParamsId> params;
  std::unordered_map<std::string, bool> families;   // names declared with an index: `pyramid` of `pyramid[2]`
  std::unordered_map<std::string, bool> instances;  // of techniques, named with an index
  std::unordered_map<std::string, const ast::BundleDeclaration*> bundles;
  std::unordered_map<std::string, Span> uses;            // instance -> where it is used
  std::set<const ast::Use*> repeated_uses;               // of a name that is taken: reported, and passed over
  std::unordered_map<std::string, bool> failed;          // declared, but wrong: stay silent about them
  std::unordered_map<std::string, uint32_t> interfaces;  // parameter -> symbol
  std::vector<bool> resource_used;
  std::set<uint32_t> told;  // resources about which a pass was told already: more about their contents would be one mistake twice
  uint32_t use_depth = 0;
  uint64_t unrolled = 0;
  bool incomplete = false;  // some access was dropped after an error: whole-graph facts would mislead
};

// ---- check_names.cpp --------------------------------------------------------------------------------------------
void collect_names(Checker& checker);
const char* describe(SymbolKind kind);
// Reports what is wrong and returns none; `expr` is a name or `module.name`.
std::optional<uint32_t> find_symbol(Checker& checker, uint32_t module, const ast::Expr& expr, SymbolKind kind);
std::optional<uint32_t> find_symbol(Checker& checker, uint32_t module, const ast::Name& name, SymbolKind kind);
// Silent: for expressions, where a name may be several things.
std::optional<uint32_t> peek_symbol(const Checker& checker, uint32_t module, const ast::Expr& expr);
// Whether a module that `module` sees keeps the name to itself; reports it.
bool report_if_private(Checker& checker, uint32_t module, std::string_view name, Span span);
std::string spelled(const ast::Expr& expr);
std::string with_article(std::string_view noun);      // "an image"
std::string counted(size_t count, const char* noun);  // "1 argument", "2 arguments"
// Reports a repeated name with a note at the first.
void report_duplicate(Checker& checker, const ast::Name& name, Span first);

// ---- check_value.cpp --------------------------------------------------------------------------------------------
Value evaluate_expr(Checker& checker, GraphScope* scope, uint32_t module, const ast::Expr& expr);
std::optional<int64_t> evaluate_integer(Checker& checker, GraphScope* scope, uint32_t module, const ast::Expr& expr, int64_t least, int64_t greatest);
std::optional<double> evaluate_number(Checker& checker, GraphScope* scope, uint32_t module, const ast::Expr& expr);
ExprId add_node(Checker& checker, const Expr& node);
ExprId to_expr(Checker& checker, Scalar64 scalar);
// False, after a report, if a struct or constant of another module has the name.
bool claim_public_name(Checker& checker, const ast::Name& name);
Scalar64 combine(Checker& checker, ExprOp op, Scalar64 a, Scalar64 b, Span span);
Value integer_value(int64_t value);
const Value& constant_value(Checker& checker, uint32_t symbol);
// False if the declaration has been read, or is being read already: then it needs itself, which is reported.
bool begin_declaration(Checker& checker, uint32_t symbol);
// ---- check_extents.cpp ------------------------------------------------------------------------------------------
ExtentId extent_of(Checker& checker, uint32_t symbol);
// Where to look at expressions of which nothing is proved: at the initial extents, then at the bounds of each axis below them in every combination,
// and at uneven ones. As evaluate() takes them; one alone if they are constant.
std::vector<std::vector<int64_t>> telling_extents(const Program& program, const std::vector<ExprId>& exprs);
// " where `view` is 320x200"; empty for constants.
std::string where_extents(const Program& program, const std::vector<ExprId>& exprs, const std::vector<int64_t>& values);

// ---- check_types.cpp --------------------------------------------------------------------------------------------
StructId struct_of(Checker& checker, uint32_t symbol);
StructId find_struct(Checker& checker, uint32_t module, const ast::Expr& name);
// Of a struct that stands in a `per_draw`; it has a name like any other.
StructId struct_in_place(Checker& checker, uint32_t module, const ast::StructDeclaration& declaration);
// The element of `T`, `T[n]`, `T[]`; count is left to the caller.
std::optional<Type> element_type(Checker& checker, uint32_t module, const ast::TypeName& type);

// Reports a struct with fields of formats, which only vertex buffers can hold, and gives false.
bool check_not_packed(Checker& checker, StructId record, Span span);

// ---- check_states.cpp -------------------------------------------------------------------------------------------
SamplerId sampler_of(Checker& checker, uint32_t symbol);
StateId state_of(Checker& checker, uint32_t symbol);
FeatureId feature_of(Checker& checker, uint32_t symbol);
// Rules are read once every feature is known.
void check_features(Checker& checker);
std::optional<Guard::Term> feature_term(Checker& checker, uint32_t module, const ast::FeatureTerm& term);
Guard::Term opposite(const Checker& checker, Guard::Term term);
// Whether some feasible choice of features satisfies the guard.
bool is_reachable(const Checker& checker, const Guard& guard);
ConditionId condition_of(Checker& checker, uint32_t symbol);
void check_engine_set(Checker& checker, uint32_t symbol);

// ---- check_variants.cpp -----------------------------------------------------------------------------------------
SpectrumId spectrum_of(Checker& checker, uint32_t symbol);

// ---- check_resources.cpp ----------------------------------------------------------------------------------------
void declare_resource(Checker& checker, GraphScope& scope, const ast::ResourceDeclaration& declaration);
void declare_parameters(Checker& checker, GraphScope& scope, const ast::GraphDeclaration& graph);
ClearValue clear_value(Checker& checker, GraphScope& scope, const ast::Expr& expr, const Resource& resource, uint32_t aspects);
// Clears of storage that the pass declares, as a pass of their own; the pass goes without them.
Pass clear_pass(const Graph& graph, Pass& pass);
// The full name with the values of its indices: `shadow[2][0]`.
std::optional<std::string> indexed_name(Checker& checker, GraphScope& scope, const ast::Name& name, const std::vector<ast::Expr>& indices);
std::optional<Role> find_role(std::string_view word);
uint32_t find_stages(Checker& checker, const std::vector<ast::Name>& words);

// ---- check_places.cpp -------------------------------------------------------------------------------------------
// Whether `expr` begins with a name whose declaration was wrong: there is nothing more to say about it.
bool is_failed(const Checker& checker, const GraphScope& scope, const ast::Expr& expr);
Place find_place(Checker& checker, GraphScope& scope, const ast::Expr& expr);
// `shadow[lamp][face]` with the values of its indices, as it is written otherwise.
std::optional<std::string> evaluated_name(Checker& checker, GraphScope& scope, const ast::Expr& expr);
// Reports a place that may not be written: an earlier frame's, or a technique's parameter without `inout`.
bool check_writable(Checker& checker, GraphScope& scope, const Place& place, const ast::Expr& expr);
// Silent probe: whether `expr` begins with the name of a resource.
bool names_resource(const GraphScope& scope, const ast::Expr& expr);
Value size_of(Checker& checker, GraphScope& scope, const Place& place);
// Of a mip of a 3D image: as many slices as it is proved to have at every choice of extents.
uint32_t least_depth(Checker& checker, const Resource& image, uint32_t mip);
uint32_t mip_count(const Resource& resource, const Range& range);
uint32_t layer_count(const Resource& resource, const Range& range);

// ---- check_passes.cpp, check_accesses.cpp, check_transfers.cpp --------------------------------------------------
void declare_pass(Checker& checker, GraphScope& scope, const ast::PassDeclaration& declaration);
struct PassScope {
  Pass pass;
  std::vector<bool> may;  // by access: the work may leave its range as it was
  bool dropped = false;   // some statement was wrong
};
std::optional<uint32_t> add_access(Checker& checker, GraphScope& scope, PassScope& out, const ast::AccessStatement& statement);
uint32_t add_plain_access(GraphScope& scope, PassScope& out, const Place& place, Mode mode, Role role);
void add_transfer(Checker& checker, GraphScope& scope, PassScope& out, const ast::TransferStatement& statement);
// ---- check_transfer_sizes.cpp
// False after a report: of what `dst` is declared to get whole a part would stay, or the command would leave one of the two.
bool sizes_fit(Checker& checker, const GraphScope& scope, TransferKind kind, const Place& src, const Place& dst, Span span);
// Fills write words.
bool fill_fits(Checker& checker, const Resource& buffer, const Range& range, Span span);
// False after a report.
bool add_features(Checker& checker, const GraphScope& scope, Pass& pass, const ast::FeaturesStatement& statement);
bool add_spectrum(Checker& checker, GraphScope& scope, PassScope& out, const ast::SpectrumStatement& statement);
bool check_spectrum_pass(Checker& checker, const Graph& graph, const Pass& pass);
// ---- check_blocks.cpp
// `block "x.glsl" scan z Stretch`: fills Pass::block. False after a report.
bool read_block(Checker& checker, GraphScope& scope, Pass& pass, const ast::ShaderStatement& statement);
// What a block may be and may touch, once its pass is read. False after a report.
bool check_block(Checker& checker, GraphScope& scope, Pass& pass, Span dispatch);
// `fuse NAME ...`: none after a report. `finish_fusion` looks at what stands in it.
FusionId declare_fusion(Checker& checker, GraphScope& scope, const ast::Fuse& node);
void finish_fusion(Checker& checker, const GraphScope& scope, FusionId fusion);
void add_host_transfer(Checker& checker, GraphScope& scope, PassScope& out, const ast::HostTransfer& statement);
void merge_reads_and_writes(Pass& pass);
// ---- check_draws.cpp
// Where the plan records the draw: each vertex struct takes the next buffer read `as vertex`, an indexed draw the one read `as index`. False after a
// report.
bool bind_buffers(Checker& checker, const Graph& graph, Pass& pass, Span draw);
// The count at the extents where it is least, if that is below `least`; where extents decide, a count of nothing may come up.
std::optional<int64_t> too_few(const Checker& checker, ExprId count, int64_t least);
// Draws count from 1 on and stay within their indices, and indirect arguments within their buffers, as far as sizes are known. False after a report.
bool check_amounts(Checker& checker, const Graph& graph, Pass& pass, Span work);
void name_hidden_accesses(Pass& pass);
bool is_shader_role(Role role);
bool is_attachment(Role role);
bool is_written(Mode mode);
// ---- check_roles.cpp
const char* word_of(Role role);
bool reads_only(Role role);
bool suits_kind(const Resource& resource, Role role);
bool is_storage_format(Format format);
// Whether somebody can bring the resource in that state, or take it in it. False after a report.
bool check_boundary(Checker& checker, const Resource& resource, const BoundaryState& state, Span span);

// ---- check_control.cpp ------------------------------------------------------------------------------------------
void check_graph(Checker& checker, uint32_t symbol);
// What is wrong inside a technique or bundle may be so only for who uses it: a note on each row from `first` on.
void note_since(Checker& checker, size_t first, Span span, const std::string& name);

// ---- rules over the finished graph ------------------------------------------------------------------------------
void check_pass_rules(Checker& checker, const Graph& graph, const Pass& pass);
// Histories that some frame may not write, to be carried forward; reports those that nothing writes.
std::vector<ResourceId> find_carried(Checker& checker, const Graph& graph);
void carry_forward(Graph& graph, const std::vector<ResourceId>& histories);
void check_definitions(Checker& checker, const Graph& graph, const std::set<uint32_t>& told);
void check_unused(Checker& checker, const GraphScope& scope);
void check_block_layouts(Checker& checker, const Graph& graph);

}  // namespace rg::dsl
