// Litmus cases on buffers: execution and memory dependencies, chains, scopes.
#include "tests/unit/verify/litmus.h"

namespace rg::verify {
namespace {

const Litmus kMemoryCases[] = {
    {"ReadAfterWriteOrdered",
     "Memory dependency: availability of the first access scope, visibility to the second",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.buffer_barrier(x, st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"ReadAfterWriteBare",
     "Execution and Memory Dependencies: commands may overlap unless synchronised",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.compute("r", {reads(x)});
     }},
    {"ReadAfterWriteExecutionOnly",
     "Access scopes hold only what is listed",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, 0, st::compute_shader, 0);
       b.compute("r", {reads(x)});
     }},
    {"ReadAfterWriteNotAvailable",
     "VkMemoryBarrier2: the first access scope is limited to srcAccessMask",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, 0, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"ReadAfterWriteNotVisible",
     "VkMemoryBarrier2: the second access scope is limited to dstAccessMask",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::uniform_read);
       b.compute("r", {reads(x)});
     }},
    {"ReadAfterWriteWrongSource",
     "The first scope is limited to srcStageMask",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::fragment_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"ReadAfterWriteWrongDestination",
     "The second scope is limited to dstStageMask",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::fragment_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"WriteAfterReadExecutionOnly",
     "Write-after-read needs an execution dependency only",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("r", {reads(x)});
       b.memory(st::compute_shader, 0, st::copy, 0);
       b.transfer("w", {writes(x, Role::copy_dst)});
     }},
    {"WriteAfterReadBare",
     "Write-after-read needs an execution dependency",
     {"write-after-read"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("r", {reads(x)});
       b.transfer("w", {writes(x, Role::copy_dst)});
     }},
    {"StorageWriteAfterWriteBare",
     "Write-after-write is a hazard between storage writes too (validation layers do not report it)",
     {"write-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w1", {writes(x)});
       b.compute("w2", {writes(x)});
     }},
    {"WriteAfterWriteOrdered",
     "Write-after-write needs a memory dependency",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w1", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_write);
       b.compute("w2", {writes(x)});
     }},
    {"WriteAfterWriteExecutionOnly",
     "Write-after-write needs a memory dependency, not only execution",
     {"write-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w1", {writes(x)});
       b.memory(st::compute_shader, 0, st::compute_shader, 0);
       b.compute("w2", {writes(x)});
     }},
    {"TransferThenShaderWrite",
     "Fills belong to the clear stage; write-after-write across stages",
     {"write-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("fill", {writes(x, Role::fill_dst)});
       b.memory(st::copy, ac::transfer_write, st::compute_shader, ac::shader_storage_write);
       b.compute("w", {writes(x)});
     }},
    {"SourceCoversEarlierStages",
     "The first scope includes logically earlier stages",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.raster("draw", {reads(x, Role::indirect)});
       b.memory(st::vertex_shader, 0, st::compute_shader, 0);
       b.compute("w", {writes(x)});
     }},
    {"SourceLeavesLaterStages",
     "The first scope does not include logically later stages",
     {"write-after-read"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.raster("draw", {reads(x, Role::storage, kFs)});
       b.memory(st::vertex_shader, 0, st::compute_shader, 0);
       b.compute("w", {writes(x)});
     }},
    {"DestinationCoversLaterStages",
     "The second scope includes logically later stages",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("r", {reads(x)});
       b.memory(st::compute_shader, 0, st::vertex_shader, 0);
       b.raster("draw", {writes(x, Role::storage, kFs)});
     }},
    {"DestinationLeavesEarlierStages",
     "The second scope does not include logically earlier stages",
     {"write-after-read"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("r", {reads(x)});
       b.memory(st::compute_shader, 0, st::fragment_shader, 0);
       b.raster("draw", {writes(x, Role::storage, kVs)});
     }},
    {"AccessScopeDoesNotGrow",
     "Access scopes do not include logically later stages",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::vertex_shader, ac::shader_storage_read);
       b.raster("draw", {reads(x, Role::storage, kFs)});
     }},
    {"ComputeIsNoGraphicsStage",
     "Logical order relates stages of one pipeline type",
     {"write-after-read"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("r", {reads(x)});
       b.memory(st::color_attachment_output, 0, st::copy, 0);
       b.transfer("w", {writes(x, Role::copy_dst)});
     }},
    {"IndirectPrecedesCompute",
     "DRAW_INDIRECT is the first stage of compute pipelines too",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("r", {reads(x, Role::copy_src)});
       b.memory(st::copy, 0, st::draw_indirect, 0);
       b.compute("w", {writes(x)});
     }},
    {"ChainThroughLaterStage",
     "Execution dependency chain: the second scope of one meets the first scope of the next",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("w", {writes(x, Role::copy_dst)});
       b.memory(st::copy, ac::transfer_write, st::vertex_shader, 0);
       b.memory(st::fragment_shader, 0, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"ChainBroken",
     "Execution dependency chain: scopes that do not meet make no chain",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("w", {writes(x, Role::copy_dst)});
       b.memory(st::copy, ac::transfer_write, st::fragment_shader, 0);
       b.memory(st::vertex_shader, 0, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"AvailabilityIsNotChained",
     "Only accesses by the listed source stages are in the first access scope",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("w", {writes(x, Role::copy_dst)});
       b.memory(st::copy, 0, st::compute_shader, 0);
       b.memory(st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"BarriersOfOneCommandDoNotChain",
     "vkCmdPipelineBarrier2: each barrier has its own scopes before and after the command",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("w", {writes(x, Role::copy_dst)});
       b.memory(st::copy, ac::transfer_write, st::vertex_shader, 0);
       b.memory(st::vertex_shader, 0, st::compute_shader, ac::shader_storage_read, true);
       b.compute("r", {reads(x)});
     }},
    {"OtherBufferOrdersExecution",
     "A buffer barrier's execution dependency is not limited to its buffer",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("r", {reads(x)});
       b.buffer_barrier(y, st::compute_shader, 0, st::copy, 0);
       b.transfer("w", {writes(x, Role::copy_dst)});
     }},
    {"OtherBufferDoesNotMakeVisible",
     "A buffer barrier's memory dependency is limited to its buffer",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x"), y = b.buffer("y");
       b.compute("w", {writes(x)});
       b.buffer_barrier(y, st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"EveryReadingStage",
     "Visibility is by stage and access",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::vertex_shader, ac::shader_storage_read);
       b.raster("r", {reads(x, Role::storage, kVs | kFs)});
     }},
    {"ReadsDoNotConflict",
     "Two reads are no hazard",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read | ac::uniform_read);
       b.compute("r1", {reads(x)});
       b.compute("r2", {reads(x, Role::uniform)});
     }},
    {"SecondReaderByChain",
     "Available memory is made visible by a later dependency in the chain",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read);
       b.compute("r1", {reads(x)});
       b.memory(st::compute_shader, 0, st::fragment_shader, ac::shader_storage_read);
       b.raster("r2", {reads(x, Role::storage, kFs)});
     }},
    {"WriteAfterReadOfWrite",
     "A write ordered after readers that saw the earlier write needs no more",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::fragment_shader, ac::shader_storage_read);
       b.raster("r", {reads(x, Role::storage, kFs)});
       b.memory(st::fragment_shader, 0, st::copy, 0);
       b.transfer("w2", {writes(x, Role::copy_dst)});
     }},
    {"DisjointBytes",
     "Hazards are between overlapping memory",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       Do low = writes(x), high = writes(x);
       low.range.offset = b.program_constant(0), low.range.size = b.program_constant(512);
       high.range.offset = b.program_constant(512), high.range.size = b.program_constant(512);
       b.compute("low", {low});
       b.compute("high", {high});
     }},
    {"OverlappingBytes",
     "Hazards are between overlapping memory",
     {"write-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       Do low = writes(x), high = writes(x);
       low.range.offset = b.program_constant(0), low.range.size = b.program_constant(516);
       high.range.offset = b.program_constant(512), high.range.size = b.program_constant(512);
       b.compute("low", {low});
       b.compute("high", {high});
     }},
    {"ShaderReadCoversStorage",
     "SHADER_READ is SHADER_SAMPLED_READ and SHADER_STORAGE_READ",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_write, st::compute_shader, ac::shader_read);
       b.compute("r", {reads(x)});
     }},
    {"ShaderReadLeavesUniform",
     "UNIFORM_READ is an access of its own",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_write, st::compute_shader, ac::shader_read);
       b.compute("r", {reads(x, Role::uniform)});
     }},
    {"AllTransferCoversCopy",
     "ALL_TRANSFER is COPY, BLIT, RESOLVE and CLEAR",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("w", {writes(x, Role::copy_dst)});
       b.memory(st::all_transfer, ac::transfer_write, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"IndirectArguments",
     "Indirect arguments are read in DRAW_INDIRECT, for dispatches too",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::draw_indirect, ac::indirect_command_read);
       b.compute("r", {reads(x, Role::indirect)});
     }},
    {"IndirectArgumentsForgotten",
     "Indirect arguments are not read in COMPUTE_SHADER",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x, Role::indirect)});
     }},
    {"IndexAndVertexInput",
     "INDEX_INPUT and VERTEX_ATTRIBUTE_INPUT are stages of their own",
     {"read-after-write"},
     [](Builder& b) {
       const auto v = b.buffer("v"), i = b.buffer("i");
       b.transfer("w", {writes(v, Role::copy_dst), writes(i, Role::copy_dst)});
       b.memory(st::copy, ac::transfer_write, st::vertex_attribute_input, ac::vertex_attribute_read);
       b.raster("r", {reads(v, Role::vertex), reads(i, Role::index)});
     }},
    {"AtomicsCommute",
     "Atomic accesses to one location are no data race",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("clear", {writes(x, Role::fill_dst)});
       b.memory(st::clear, ac::transfer_write, st::compute_shader, ac::shader_storage_read | ac::shader_storage_write);
       b.compute("a1", {counts(x)});
       b.compute("a2", {counts(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"AtomicsAfterClear",
     "An atomic is a read and a write",
     {"read-after-write", "write-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("clear", {writes(x, Role::fill_dst)});
       b.compute("a1", {counts(x)});
     }},
    {"ReadAfterAtomicGroup",
     "Every member of the group must be visible to the reader",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("clear", {writes(x, Role::fill_dst)});
       b.memory(st::clear, ac::transfer_write, st::compute_shader | st::fragment_shader, ac::shader_storage_read | ac::shader_storage_write);
       b.compute("a1", {counts(x)});
       b.raster("a2", {counts(x, kFs)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read);
       b.compute("r", {reads(x)});
     }},
    {"DisjointWriters",
     "Writers of different elements touch different memory",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.transfer("clear", {writes(x, Role::fill_dst)});
       b.memory(st::clear, ac::transfer_write, st::compute_shader, ac::shader_storage_read | ac::shader_storage_write);
       b.compute("a", {updates(x).apart()});
       b.compute("b", {updates(x).apart()});
     }},
    {"HostReadWithoutHostBarrier",
     "A fence makes no writes visible to the host: HOST_READ in stage HOST does",
     {"read-after-write"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.lifetime(x, dsl::Lifetime::readback);
       b.compute("w", {writes(x)});
     }},
    {"HostRead",
     "HOST_READ in stage HOST",
     {},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.lifetime(x, dsl::Lifetime::readback);
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::host, ac::host_read);
     }},
    {"AccessNeedsItsStage",
     "VUID-VkMemoryBarrier2-dstAccessMask: an access must be supported by a stage of the mask",
     {"invalid barrier"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::compute_shader, ac::shader_storage_write, st::compute_shader, ac::shader_storage_read | ac::transfer_read);
       b.compute("r", {reads(x)});
     }},
    {"AllCommandsRefused",
     "No plan needs ALL_COMMANDS in a barrier",
     {"invalid barrier"},
     [](Builder& b) {
       const auto x = b.buffer("x");
       b.compute("w", {writes(x)});
       b.memory(st::all_commands, ac::memory_write, st::all_commands, ac::memory_read);
       b.compute("r", {reads(x)});
     }},
};

class MemoryLitmus : public ::testing::TestWithParam<Litmus> {};
TEST_P(MemoryLitmus, IsDecided) { decide(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Litmus, MemoryLitmus, ::testing::ValuesIn(kMemoryCases), litmus_name);

}  // namespace
}  // namespace rg::verify
