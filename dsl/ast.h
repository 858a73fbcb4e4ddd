// The tree of one file, as written: a value tree. Views point into the file's text, which outlives the tree.
// A node with `has_error` was already complained about; later phases pass over it in silence.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "dsl/source.h"

namespace rg::dsl::ast {

// An optional value that costs a pointer where it is absent: most parts of most nodes are.
template <class T>
class Boxed {
 public:
  Boxed() = default;
  Boxed(T value) : value_(std::make_unique<T>(std::move(value))) {}
  explicit operator bool() const { return value_ != nullptr; }
  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return value_.get(); }
  const T* operator->() const { return value_.get(); }

 private:
  std::unique_ptr<T> value_;
};

struct Name {
  std::string_view text;
  Span span;
  bool empty() const { return text.empty(); }
};

// ---- expressions ------------------------------------------------------------------------------------------------

enum class ExprKind : uint8_t {
  error,
  integer,
  real,        // value
  dimensions,  // 1920x1080: operands are integers
  name,        // text
  member,      // operands[0].text
  index,       // operands[0][operands[1]]
  call,        // operands[0](operands[1...])
  list,        // [a, b, c] or (a, b)
  negate,
  add,
  sub,
  mul,
  div,
  mod,
};
struct Expr {
  ExprKind kind = ExprKind::error;
  Span span;
  std::string_view text;
  int64_t integer = 0;
  double real = 0;
  std::vector<Expr> operands;
};

// `culling.Light`, `u32`, with `[n]` or `[]` behind it
struct TypeName {
  Expr name;             // name or member
  Boxed<Expr> count;     // [n]
  bool unsized = false;  // []
  Span span;
};

// ---- declarations at file level ---------------------------------------------------------------------------------

struct Import {
  std::string_view path;
  Span span;
};
struct Target {
  Name api;
  double version = 0;
  Name with;  // `split_barriers`, or nothing
  Span span;
};
struct ProfileTarget {  // `target profile "profiles/desktop.json"`
  std::string_view path;
  Span span;
};
struct Constant {
  Name name;
  Expr value;
};
struct ExtentDeclaration {
  Name name;
  std::vector<Expr> initial, minimum, maximum;
  Span span;
};
struct FieldDeclaration {
  Name name;
  TypeName type;
};
struct StructDeclaration {
  Name name;
  bool scalar = false;  // `struct Particle scalar { ... }`
  std::vector<FieldDeclaration> fields;
};

// A word with its values: `filter linear`, `bias 1.0 2.0`, `depth test greater`, `mips 6`, `no alias`.
struct Setting {
  Name word, second;         // second: `test` of `depth test`, `alias` of `no alias`
  std::vector<Name> names;   // values that are words
  std::vector<Expr> values;  // values that are numbers
  Span span;
};
struct SamplerDeclaration {
  Name name;
  std::vector<Setting> settings;
};
struct StateDeclaration {
  Name name;
  std::vector<Setting> settings;
};
struct FeatureTerm {  // `fog`, `not fog`, `path == low`, `path != low`
  Name feature, value;
  bool negated = false;
  Span span;
};
struct FeatureRule {  // `requires TERM`, `excludes TERM`: of the feature where it is on, or of one of its values
  Name value;         // empty: on
  FeatureTerm term;
  bool excludes = false;
};
struct FeatureDeclaration {
  Name name;
  bool is_bool = true;
  Name capability;  // `feature sums : device subgroup_arithmetic`; empty: the application decides
  std::vector<Name> values;
  std::vector<FeatureRule> rules;
};
struct ConditionDeclaration {
  Name name;
  Boxed<Expr> count;  // `condition cache_miss[8]`
};
struct SpectrumDeclaration {
  struct Member {
    Name name;
    std::vector<Name> needs;
  };
  Name name;
  std::vector<Member> members;
  Boxed<Expr> modes;
  std::string_view profile;
  Span profile_span;
};
struct EngineSetDeclaration {
  Name name;
  int64_t set = 0;
  std::string_view glsl;
  Span set_span;
};

// `sampled(clamp) in fragment, compute`
struct Usage {
  Name role;
  Boxed<Expr> sampler;
  std::vector<Name> stages;
  Span span;
};
struct ResourceDeclaration {
  bool is_buffer = false;
  Name name;
  std::vector<Expr> index;  // `image pyramid[i]`, one for each pair of brackets
  Name format;              // images
  Boxed<Expr> size;         // images
  TypeName element;         // buffers
  std::vector<Setting> settings;
  Boxed<Expr> clear;  // of `init clear V`
  bool has_init = false;
  Boxed<Usage> ready, after;
  bool wrote = false;  // `written as`, not `ready as`
  bool has_error = false;
  Span span;
};
struct InterfaceDeclaration {
  Name name;
  std::vector<ResourceDeclaration> members;
};

// ---- passes -----------------------------------------------------------------------------------------------------

enum class Verb : uint8_t { read, write, update, atomic, color, depth, stencil };
struct BlendOption {
  Name op;
  std::vector<Name> factors;
  Span span;
};
struct AccessStatement {
  Verb verb = Verb::read;
  Name rename;
  Expr target;
  Boxed<Usage> usage;
  std::vector<Name> stages;  // of `in STAGES` where no role says them
  Boxed<Expr> clear;
  Boxed<BlendOption> blend;
  bool covers = false, disjoint = false, readonly = false;
  Span span;
};
struct ShaderStatement {
  struct Path {
    std::string_view text;
    Span span;
  };
  std::vector<Path> paths;
  std::vector<Expr> group;
  bool fullscreen = false, block = false;
  Name scan;  // of a block: the axis it is walked along; empty: none
  Boxed<TypeName> carry;
  bool associative = false;
  Span span;
};
struct DispatchStatement {
  Name how;  // over, groups, indirect, host
  Boxed<Expr> size;
  Span span;
};
struct PerDraw {
  Name name;
  Boxed<Expr> type;                      // by name
  Boxed<StructDeclaration> declaration;  // or in place
};
struct VertexStatement {  // `vertex Mesh`, `instance Placement`
  Expr type;
  bool per_instance = false;
};
struct DrawStatement {
  bool host = false, indirect = false, indexed = false;
  Boxed<Expr> vertices, instances, first, offset, arguments, max_draws, counts;
  Boxed<PerDraw> per_draw;
  std::vector<VertexStatement> vertex;
  Span span;
};
struct TransferStatement {
  Name verb;  // copy, blit, clear, fill, update, resolve
  Boxed<Expr> src, dst, value;
  bool linear = false;
  Span span;
};
struct HostTransfer {
  std::vector<AccessStatement> accesses;
  Span span;
};
struct ParamsStatement {
  Name name;
  Boxed<Expr> type;
  Span span;
};
struct WordStatement {  // state NAME, bind NAME, after PASS, with BUNDLE, keep, multiview
  Name word;
  Boxed<Expr> value;
  Span span;
};
struct FeaturesStatement {  // features fog, shading
  std::vector<Name> names;
  Span span;
};
struct SpectrumStatement {  // spectrum light_features by tile_features into tile_kernels
  Name spectrum;
  Expr masks;
  std::optional<Expr> kernels;
  Span span;
};
using Statement = std::variant<AccessStatement, ShaderStatement, DispatchStatement, DrawStatement, TransferStatement, HostTransfer, ParamsStatement,
                               WordStatement, FeaturesStatement, SpectrumStatement>;

struct BundleDeclaration {  // `bundle world { read scene.instances as storage ... }`: statements that passes take with `with world`
  Name name;
  std::vector<Statement> statements;
  bool has_error = false;
};
struct PassDeclaration {
  Name name;
  std::vector<Expr> index;  // `pass shadow[lamp][face]`
  Name kind, queue;
  bool queue_may = false;
  std::vector<Statement> statements;
  bool has_error = false;
  Span span;  // of the name with its index
};

// ---- graphs -----------------------------------------------------------------------------------------------------

struct Assertion {
  bool is_error = true;
  Name fact;
  std::vector<Expr> arguments;
  Name comparison;
  Boxed<Expr> value;
  Name unit, on;  // on: `on two_queues`
  std::string_view text;
  Span span;
};
struct Item;
struct For {
  Name variable;
  Expr first, last;
  std::vector<Item> body;
  Span span;
};
struct When {
  FeatureTerm term;
  std::vector<Item> body, otherwise;
  Span span;
};
struct IfHost {
  Name condition;
  Boxed<Expr> index;
  std::vector<Item> body;
  Span span;
};
struct Use {  // `use blur(hdr, inout color)`, `use left = blur(hdr)`, `use eye[i] = blur(hdr)`
  Name instance;
  std::vector<Expr> index;       // of the instance
  std::vector<Name> directions;  // of each argument: `in`, `out` or `inout` before it, or empty
  Expr technique;
  std::vector<Expr> arguments;
  Span span;
};
struct Fuse {  // `fuse fog may unrounded when merged { pass ... }`
  Name name;
  bool may = false, unrounded = false;
  Boxed<FeatureTerm> term;
  std::vector<Item> body;
  Span span;
};
struct Item {
  std::variant<ResourceDeclaration, PassDeclaration, BundleDeclaration, For, When, IfHost, Use, Assertion, Fuse> node;
};
struct Parameter {
  enum class Kind : uint8_t { params, surface, interface, image, buffer, constant } kind = Kind::interface;
  Name name;
  Expr type;                                                                    // struct or interface
  ResourceDeclaration surface;                                                  // surface
  enum class Direction : uint8_t { in, out, inout } direction = Direction::in;  // image and buffer parameters of a technique
  Span span;
};
struct GraphDeclaration {  // or, as `technique`, a piece of one
  Name name;
  bool is_technique = false;
  std::vector<Parameter> parameters;
  std::vector<Item> body;
  bool has_error = false;
};

using Declaration = std::variant<Constant, ExtentDeclaration, StructDeclaration, InterfaceDeclaration, SamplerDeclaration, StateDeclaration,
                                 FeatureDeclaration, ConditionDeclaration, EngineSetDeclaration, GraphDeclaration, SpectrumDeclaration>;
struct Allow {  // `allow RG0388`
  Name code;
  Span span, scope;  // scope: of the declaration, block or file that it stands in
};
struct File {
  FileId file;
  Name module;
  std::optional<Target> target;
  Span repeated_target;  // of another `target vulkan`, which is a mistake
  std::vector<ProfileTarget> profiles;
  std::vector<Import> imports;
  std::vector<Declaration> declarations;
  std::vector<Allow> allows;
  std::vector<Name> private_words;  // of each declaration; empty: other modules see it
  bool has_error = false;           // something did not parse
  bool lost_names = false;          // ... and it was a declaration: unknown names may be our fault
  bool lost_structure = false;      // braces do not match
};

}  // namespace rg::dsl::ast
