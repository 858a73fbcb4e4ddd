// The checked program: what a `.rg` file and its imports mean, with every name resolved, every constant folded,
// every loop unrolled and every technique instantiated. The one input of the planner and of the checker.
//
// Nothing here knows Vulkan. Extents stay symbolic (Expr), because they are chosen when the program runs.
// Access order inside a pass is the order written; pass order inside a graph is program order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dsl/fixed_function.h"
#include "dsl/ids.h"
#include "dsl/source.h"

// Rows that belong together share a line.
// clang-format off
namespace rg::dsl {

using ExprId = Id<struct ExprTag>;
using StructId = Id<struct StructTag>;
using SamplerId = Id<struct SamplerTag>;
using StateId = Id<struct StateTag>;
using ExtentId = Id<struct ExtentTag>;
using FeatureId = Id<struct FeatureTag>;
using ConditionId = Id<struct ConditionTag>;
using GraphId = Id<struct GraphTag>;
using ResourceId = Id<struct ResourceTag>;  // indexes Graph::resources
using PassId = Id<struct PassTag>;          // indexes Graph::passes
using SpectrumId = Id<struct SpectrumTag>;
using ParamsId = Id<struct ParamsTag>;      // indexes Graph::params
using FusionId = Id<struct FusionTag>;      // indexes Graph::fusions

// ---- values known when the program runs -------------------------------------------------------------------------

// A flat expression over int64. Operands precede the node that uses them.
enum class ExprOp : uint8_t {
  constant,     // value
  extent,       // value: 3 * ExtentId + axis (0 width, 1 height, 2 depth); at run time the chosen extent
  add, sub, mul,
  floor_div,    // rounds down, as mip sizes do
  ceil_div,     // ceil(a / b)
  min, max,
  mip,          // max(a >> b, 1)
};
struct Expr {
  ExprOp op = ExprOp::constant;
  ExprId a, b;
  int64_t value = 0;
  friend bool operator==(const Expr&, const Expr&) = default;
};

// `extent view = runtime(1920, 1080) min(320, 200) max(3840, 2160)`; a scalar, `extent slices = runtime(32) max(64)`, has one axis
struct Extent {
  std::string name;
  int64_t initial[3] = {1, 1, 1};
  int64_t maximum[3] = {1, 1, 1};
  uint32_t axes = 2;
  Span span;
  int64_t minimum[3] = {1, 1, 1};
  friend bool operator==(const Extent&, const Extent&) = default;
};

// ---- types ------------------------------------------------------------------------------------------------------

enum class Format : uint8_t {
  none,
#define RG_FORMAT(name, ...) name,
#include "dsl/format.def"
#undef RG_FORMAT
};
const char* name(Format format);

enum class Scalar : uint8_t { f32, i32, u32, boolean };
struct Type {  // scalar, vector (columns 1), matrix, or struct; `count` 0 means not an array
  Scalar scalar = Scalar::f32;
  uint8_t rows = 1, columns = 1;
  StructId record;  // valid: a struct, and the fields above are unused
  uint32_t count = 0;
  Format packed = Format::none;  // of a vertex: the format of its bytes, which shaders see as what stands above
  friend bool operator==(const Type&, const Type&) = default;
};
struct Field {
  std::string name;
  Type type;
  uint32_t offset140 = 0, offset430 = 0;  // bytes
  Span span;
  friend bool operator==(const Field&, const Field&) = default;
};
struct Struct {
  std::string name;
  std::vector<Field> fields;
  uint32_t size140 = 0, align140 = 0, size430 = 0, align430 = 0;  // bytes; size430 is also the array stride
  Span span;
  friend bool operator==(const Struct&, const Struct&) = default;
};

// ---- resources --------------------------------------------------------------------------------------------------

enum class ResourceKind : uint8_t { image, buffer };
enum class Dimension : uint8_t { d1, d2, d3, cube };
enum class Lifetime : uint8_t {
  transient,   // contents end with the frame; memory may be shared
  history,     // `history n`: n previous final versions stay readable as prev(1..n)
  persistent,  // contents stay; `init` defines the first frame
  imported,    // brought by the host each frame in state `before`, left in `after`
  readback,    // buffer the host reads after the frame; one copy a frame in flight
};
enum class InitKind : uint8_t { none, clear };

// Where an access happens, as a role. What it means to the GPU is the compiler's business.
enum class Role : uint8_t {
  sampled, storage, uniform, vertex, index, indirect,
  color, depth, depth_readonly, stencil, input, resolve_src, resolve_dst,
  copy_src, copy_dst, blit_src, blit_dst, clear_dst, fill_dst, update_dst,
  host_read, host_write, present, undefined /* imported contents are worthless */,
};
enum class Mode : uint8_t { read, write, update, atomic };  // write defines all of its range; update keeps the rest

enum Stage : uint32_t {  // programmable and fixed stages an access may name with `in`
  stage_none = 0, stage_vertex = 1, stage_tess_control = 2, stage_tess_eval = 4, stage_geometry = 8, stage_fragment = 16,
  stage_compute = 32, stage_transfer = 64, stage_host = 128,
};

struct BoundaryState {  // `ready as storage in compute`
  Role role = Role::undefined;
  uint32_t stages = 0;  // Stage bits; 0: the role's own
  bool wrote = false;   // the state comes from a write that is not yet visible
  friend bool operator==(const BoundaryState&, const BoundaryState&) = default;
};

// A conjunction of feature values; empty is always. `when fog` adds {fog, 1}, its `else` {fog, 0}.
struct Guard {
  struct Term {
    FeatureId feature;
    uint32_t value = 0;
    bool negated = false;
    friend bool operator==(const Term&, const Term&) = default;
  };
  std::vector<Term> terms;
  friend bool operator==(const Guard&, const Guard&) = default;
};

struct ClearValue {  // floats or integers by the format; depth in f[0], stencil in u[1]
  bool integer = false;
  float f[4] = {0, 0, 0, 0};
  uint32_t u[4] = {0, 0, 0, 0};
  friend bool operator==(const ClearValue&, const ClearValue&) = default;
};

struct Resource {
  std::string name;        // unique in the graph; loop instances are `name[2]`, interface members `scene.lights`
  std::string module;      // `frame`, `lighting`
  ResourceKind kind = ResourceKind::image;
  Lifetime lifetime = Lifetime::transient;
  // images
  Dimension dimension = Dimension::d2;
  Format format = Format::none;
  ExprId width, height, depth;      // texels of mip 0; height/depth invalid means 1
  uint32_t mips = 1;                // declared maximum; an instance has min(mips, full chain)
  uint32_t layers = 1, samples = 1; // cubes count 6 a cube
  // buffers
  Type element;                     // `u32[n]`; raw buffers are u32
  uint32_t stride = 0;              // bytes, std430
  ExprId count;                     // elements
  // lifetimes
  uint32_t history = 0;
  InitKind init = InitKind::none;
  ClearValue init_value;
  BoundaryState before, after;      // imported
  bool is_surface = false;          // imported image the result is shown on
  bool is_output = false;           // observable: its producer is never culled
  bool no_alias = false;
  bool layout_general = false;      // images: every use but presenting keeps the general layout
  Guard guard;
  Span span;
  friend bool operator==(const Resource&, const Resource&) = default;
};

constexpr uint32_t kAll = UINT32_MAX;
struct Range {  // of one image or buffer; kAll counts reach to the end
  uint32_t aspects = 0;  // 1 colour, 2 depth, 4 stencil; 0: those of the format
  uint32_t mip = 0, mips = kAll, layer = 0, layers = kAll;
  ExprId offset, size;   // buffer bytes; invalid: whole
  uint32_t slice = 0, slices = kAll;  // of a 3D image as an attachment; synchronisation knows mips, not slices
  friend bool operator==(const Range&, const Range&) = default;
};

// ---- passes -----------------------------------------------------------------------------------------------------

struct Access {
  ResourceId resource;
  Range range;
  uint32_t age = 0;        // prev(age) of a history resource
  Mode mode = Mode::read;
  Role role = Role::sampled;
  uint32_t stages = 0;     // Stage bits declared with `in`; 0: from the shaders of the pass
  SamplerId sampler;       // sampled through; invalid: texelFetch only
  std::string name;        // what shaders and the generated API call it
  std::optional<ClearValue> clear;  // cleared before use
  Blend blend;             // color
  bool covers = false;     // raster: declared to define every element
  bool disjoint = false;   // writers declared to touch different elements
  Span span;
  Format view = Format::none;  // shaders and attachments see the image through this format of the same size; none: its own
  bool element = false;        // `as element`: a block touches the element it runs for and no other
  friend bool operator==(const Access&, const Access&) = default;
};

enum class PassKind : uint8_t { raster, compute, transfer, host };
enum class QueueKind : uint8_t { graphics, compute, transfer };
struct Shader {
  Stage stage = stage_compute;
  std::string path;        // relative to the root file's folder, whatever module names it
  Span span;
  std::string text = {};   // of a shader the compiler wrote itself; empty: read the file
  friend bool operator==(const Shader&, const Shader&) = default;
};

enum class DrawKind : uint8_t { none, fullscreen, direct, indirect, indirect_count, host };
struct VertexInput {  // one binding
  StructId type;
  bool per_instance = false;
  uint32_t buffer = kAll;  // index into Pass::accesses, role vertex; kAll: the host binds it
  friend bool operator==(const VertexInput&, const VertexInput&) = default;
};
struct Draw {
  DrawKind kind = DrawKind::none;
  ExprId vertices, instances;   // direct; indices where indexed
  ExprId first, offset;         // direct: of the first vertex or index, and what is added to indices; invalid: 0
  uint32_t arguments = kAll, counts = kAll;  // indices into Pass::accesses, role indirect
  uint32_t max_draws = 1, stride = 16;       // indirect: VkDrawIndirectCommand; indexed: 20
  bool indexed = false;
  uint32_t indices = kAll;      // index into Pass::accesses, role index; kAll: none, or the host binds them
  StructId per_draw;            // push constants of each draw
  std::vector<VertexInput> vertex;  // in order; locations run on through the fields
  friend bool operator==(const Draw&, const Draw&) = default;
};

enum class DispatchKind : uint8_t { none, over, groups, indirect, host };
struct Dispatch {
  DispatchKind kind = DispatchKind::none;
  ExprId size[3];                 // `over`: invocations, divided by the group size rounding up; `groups`: groups
  uint32_t arguments = kAll;      // index into Pass::accesses
  uint32_t group[3] = {1, 1, 1};  // `group 8 8 1`
  friend bool operator==(const Dispatch&, const Dispatch&) = default;
};

enum class TransferKind : uint8_t { copy, blit, clear, fill, update, resolve, host };
struct Transfer {  // accesses are indices into Pass::accesses
  TransferKind kind = TransferKind::copy;
  uint32_t src = kAll, dst = kAll;
  Filter filter = Filter::nearest;
  ClearValue value;               // clear; fill in u[0]
  std::string data;               // update: what the generated API calls the host's bytes
  friend bool operator==(const Transfer&, const Transfer&) = default;
};

// The pass runs only while mip < the image's mips at the current extent (see Resource::mips).
struct MipLimit {
  ResourceId image;
  uint32_t mip = 0;
  friend bool operator==(const MipLimit&, const MipLimit&) = default;
};

struct Params {  // a uniform block that host code fills, graph-wide or of one pass
  std::string name;
  StructId type;
  PassId pass;  // invalid: a parameter of the graph
  Span span;
  friend bool operator==(const Params&, const Params&) = default;
};

// A constant that a pass gives its shaders: the configuration's value of a feature, or a value decided for this pass alone.
struct ShaderFeature {
  std::string name;                 // as shaders write it; a `bool` where `values` is empty, else a `uint`
  FeatureId feature;                // invalid: `value` holds
  uint32_t value = 0;
  std::vector<std::string> values;  // `name_value` is each one's constant
  Span span;
  friend bool operator==(const ShaderFeature&, const ShaderFeature&) = default;
};

// A shader written for one element at a time, see compiler/fusion/write_kernel.h. The elements are those of `dispatch over`.
struct Block {
  uint32_t axes = 1;        // of the domain
  uint32_t scan = kAll;     // axis it walks near to far, carrying `carry`; kAll: elements know nothing of each other
  Type carry;
  bool associative = false; // stretches of the line may be joined in any grouping
  bool sized = false;       // `group` was written, it is not the default
  friend bool operator==(const Block&, const Block&) = default;
};

struct ParamsUse {
  std::string name;  // what the shader calls it: the technique's word for it, where a technique takes it
  ParamsId id;
  Span span;  // of the pass's own line
  friend bool operator==(const ParamsUse&, const ParamsUse&) = default;
};

struct Pass {
  std::string name;        // unique in the graph; loop instances are `bloom_down[3]`
  std::string module;
  PassKind kind = PassKind::compute;
  QueueKind queue = QueueKind::graphics;
  bool queue_may = false;  // `may`: permission to move, not an order
  std::vector<Shader> shaders;
  std::vector<Access> accesses;
  std::vector<ParamsUse> params;
  StateId state;           // raster; invalid: defaults
  Draw draw;
  Dispatch dispatch;
  std::vector<Transfer> transfers;
  std::string bind;        // `bind engine.materials`: a set the engine owns, set 0 or 2 by declaration
  std::vector<PassId> after;
  bool keep = false;       // never culled
  bool multiview = false;  // raster: each layer of the attachments is a view, drawn at once
  Guard guard;
  std::vector<ConditionId> conditions;  // latched host conditions, all must hold
  std::vector<MipLimit> mip_limits;
  std::vector<ShaderFeature> features = {};  // `features fog, shading`
  SpectrumId spectrum;     // `spectrum S by MASKS`: one kernel a mode, see compiler/spectrum/expand_spectra.h
  uint32_t masks = kAll;   // index into accesses: a u32 a group, its bits the spectrum's features
  uint32_t kernels = kAll;  // ... `into IMAGE`: the kernel that each group got; kAll: nobody asks
  std::vector<std::string> interface_lines;  // GLSL behind the generated interface, from the compiler itself
  std::optional<Block> block;  // `block "x.glsl"`: the shader is one; compute
  double work_share = 1;   // of the groups that all kernels of a spectrum share, as its profile has it
  FusionId fusion;         // the `fuse` it stands in
  Span span;               // of the pass name
  friend bool operator==(const Pass&, const Pass&) = default;
};

struct Assertion {  // `assert memory(1920x1080) <= 170 MiB`
  bool is_error = true;
  std::string fact;                       // memory, barriers, submits, overlaps, order, variants
  std::vector<std::string> arguments;     // pass or resource names
  std::optional<int64_t> extent[3];
  std::string comparison;                 // <= < == > >=
  double value = 0;
  std::string text;                       // as written
  Span span;
  friend bool operator==(const Assertion&, const Assertion&) = default;
};

// `fuse NAME may unrounded when TERM { ... }`: the blocks of its passes become one kernel, see compiler/fusion/fuse_passes.h
struct Fusion {
  std::string name;                 // of the pass that the kernel becomes
  bool may = false;                 // what cannot be fused stays as it is
  bool unrounded = false;           // values that stay in registers are not converted to their formats
  std::optional<Guard::Term> when;  // fused where it holds
  Span span;
  friend bool operator==(const Fusion&, const Fusion&) = default;
};

struct EngineSet {  // `set materials 2 { texture2D[16] albedo  sampler smooth }`: descriptors the engine owns
  std::string name;
  uint32_t set = 0;
  std::string glsl;        // declarations, as written between the braces
  Span span;
  friend bool operator==(const EngineSet&, const EngineSet&) = default;
};

// `use wide = blur(hdr, inout bloom)`: what the technique declares is called `wide.NAME`.
struct Instance {
  std::string name, technique;
  Span span, declared;  // of the `use`; of the technique's name
  friend bool operator==(const Instance&, const Instance&) = default;
};

struct Graph {
  std::string name;
  Table<ResourceId, Resource> resources;
  Table<PassId, Pass> passes;
  Table<ParamsId, Params> params;
  std::vector<Assertion> assertions;
  Table<FusionId, Fusion> fusions;
  std::vector<Instance> instances;
  Span span;
  // Not inline: in each file that includes this, copying so many tables would take long to compile.
  Graph();
  Graph(const Graph&);
  Graph(Graph&&) noexcept;
  Graph& operator=(const Graph&);
  Graph& operator=(Graph&&) noexcept;
  ~Graph();
  bool operator==(const Graph&) const;
};

// Whether an attachment leaves part of its mip as it is, whatever it clears or covers.
inline bool is_slice(const Access& access) { return access.range.slices != kAll; }

// The format in which the pass sees the image.
inline Format seen_format(const Resource& image, const Access& access) { return access.view == Format::none ? image.format : access.view; }

// ---- the whole --------------------------------------------------------------------------------------------------

// What a device is asked for by `feature NAME : device CAPABILITY`; rows of capability.def.
enum class Capability : uint8_t {
  none,
#define RG_CAPABILITY(name, meaning) name,
#include "dsl/capability.def"
#undef RG_CAPABILITY
};

struct Feature {
  std::string name;
  std::vector<std::string> values;  // bool: {"off", "on"}
  uint32_t initial = 0;
  Capability capability = Capability::none;  // the device has it or not: nobody else sets the feature
  Span span;
  struct Rule {  // where the feature has `value`, `needs` holds: `b: bool requires a`, `{ low, high excludes fog }`
    uint32_t value = 0;
    Guard::Term needs;
    Span span;
    friend bool operator==(const Rule&, const Rule&) = default;
  };
  std::vector<Rule> rules = {};  // see dsl/features.h
  friend bool operator==(const Feature&, const Feature&) = default;
};
struct Condition {  // `condition cache_miss[8]` is eight rows, `cache_miss[0]` ...
  std::string name;
  Span span;
  std::string family = {};   // `cache_miss`; empty: a single condition
  uint32_t index = 0, count = 0;
  FeatureId feature = {};             // holds where the feature has one of `values`; invalid: the host says
  std::vector<uint32_t> values = {};
  friend bool operator==(const Condition&, const Condition&) = default;
};

// What the devices of a Vulkan Profiles file promise: the features it requires, and the limits that the language can run into.
struct Profile {
  std::string name;  // the front end leaves the path of its file here, relative to the root file's folder, and the rest empty
  uint32_t api_minor = 3;                                   // Vulkan 1.x
  std::vector<std::string> features;                        // sorted; `textureCompressionBC`
  struct Limit { std::string name; double value = 0; friend bool operator==(const Limit&, const Limit&) = default; };
  std::vector<Limit> limits;                                // sorted by name; `maxPushConstantsSize`
  Span span;
  friend bool operator==(const Profile&, const Profile&) = default;
};

// Features that the GPU chooses by tile: bit i of a mask is features[i]. `modes` kernels serve all masks.
struct Spectrum {
  struct Member {
    std::string name;
    std::vector<uint32_t> needs;  // `requires`: indices of members
    Span span;
    friend bool operator==(const Member&, const Member&) = default;
  };
  std::string name;
  std::vector<Member> members;
  uint32_t modes = 8;
  std::string profile;  // relative to the root file's folder; empty: none
  std::vector<uint32_t> kernels = {};  // once chosen: their sets of features, in the order in which they are tried
  Span span, profile_span;
  friend bool operator==(const Spectrum&, const Spectrum&) = default;
};

struct Program {
  std::string module;  // of the root file
  Table<ExprId, Expr> exprs;
  Table<ExtentId, Extent> extents;
  Table<StructId, Struct> structs;
  Table<SamplerId, Sampler> samplers;
  Table<StateId, State> states;
  Table<FeatureId, Feature> features;
  Table<ConditionId, Condition> conditions;
  Table<Id<struct EngineSetTag>, EngineSet> engine_sets;
  Table<SpectrumId, Spectrum> spectra;
  struct Constant { std::string name; int64_t value = 0; friend bool operator==(const Constant&, const Constant&) = default; };
  std::vector<Constant> constants;  // public integer constants, also given to shaders and C++
  Table<GraphId, Graph> graphs;
  std::vector<Profile> profiles = {};  // every one must be able to run every graph
  bool split_barriers = false;         // the target wants the halves of a barrier apart where work stands between them
  // Not inline: in each file that includes this, copying so many tables would take long to compile.
  Program();
  Program(const Program&);
  Program(Program&&) noexcept;
  Program& operator=(const Program&);
  Program& operator=(Program&&) noexcept;
  ~Program();
  bool operator==(const Program&) const;
};

// Evaluates `id` for the extents given as 3 values each, in the order of Program::extents. O(nodes below id).
int64_t evaluate(const Program& program, ExprId id, const std::vector<int64_t>& extent_values);
// The extents' initial (or maximal) values in the form evaluate() takes.
std::vector<int64_t> initial_extents(const Program& program);
std::vector<int64_t> maximum_extents(const Program& program);
std::vector<int64_t> minimum_extents(const Program& program);

}  // namespace rg::dsl
