// The file is what the driver gave behind a header of our own:
//
//   magic "rgcpipe\n" │ u32 version │ u32 driver version │ u64 bytes of the data │ u64 checksum of the data │ data
//
// The data begins with VkPipelineCacheHeaderVersionOne. Drivers check that much themselves and trust what follows, hence the checksum. Numbers are
// little-endian, there as here.
#include "runtime/pipeline_cache.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

#include "runtime/device_state.h"
#include "runtime/errors.h"
#include "runtime/files.h"
#include "runtime/plan_fields.h"

namespace rg {

namespace {

constexpr std::string_view kMagic = "rgcpipe\n";
constexpr uint32_t kVersion = 1;
constexpr size_t kHeaderBytes = 8 + 4 + 4 + 8 + 8;
constexpr size_t kDriverHeaderBytes = 4 * 4 + VK_UUID_SIZE;
constexpr size_t kMaxData = size_t{256} << 20;

using CacheBytes = std::span<const std::byte>;

uint64_t number_at(CacheBytes bytes, size_t at, size_t size) {
  uint64_t value = 0;
  for (size_t i = 0; i < size; ++i) value |= std::to_integer<uint64_t>(bytes[at + i]) << 8 * i;
  return value;
}

void put(std::byte*& at, uint64_t value, size_t size) {
  for (size_t i = 0; i < size; ++i) *at++ = static_cast<std::byte>(value >> 8 * i);
}

std::array<std::byte, kHeaderBytes> header_of(CacheBytes data, uint64_t checksum, const CacheIdentity& identity) {
  std::array<std::byte, kHeaderBytes> header;
  std::byte* at = std::transform(kMagic.begin(), kMagic.end(), header.data(), [](char c) { return static_cast<std::byte>(c); });
  put(at, kVersion, 4), put(at, identity.driver, 4), put(at, data.size(), 8), put(at, checksum, 8);
  return header;
}

// VkPipelineCacheHeaderVersionOne, as the driver has written it.
bool is_of(CacheBytes data, const CacheIdentity& identity) {
  if (data.size() < kDriverHeaderBytes) return false;
  const uint64_t header_bytes = number_at(data, 0, 4);
  return header_bytes >= kDriverHeaderBytes && header_bytes <= data.size() && number_at(data, 4, 4) == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
         number_at(data, 8, 4) == identity.vendor && number_at(data, 12, 4) == identity.device &&
         std::memcmp(&data[16], identity.uuid.data(), identity.uuid.size()) == 0;
}

// The data, where the whole file is what this device has written; else nothing.
CacheBytes trusted_data(CacheBytes file, const CacheIdentity& identity) {
  if (file.size() < kHeaderBytes) return {};
  const CacheBytes data = file.subspan(kHeaderBytes);
  const auto expected = header_of(data, plan_file::checksum(data), identity);
  return std::equal(expected.begin(), expected.end(), file.begin()) && is_of(data, identity) ? data : CacheBytes{};
}

VkResult create_cache(const Device::State& state, CacheBytes data, VkPipelineCache& cache) {
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = data.size();
  info.pInitialData = data.data();
  return state.vk.CreatePipelineCache(state.device, &info, state.vk.allocator, &cache);
}

}  // namespace

Status open_pipeline_cache(Device::State& state, const std::string& path) {
  PipelineCacheFile& file = state.cache_file;
  const Result<std::vector<std::byte>> bytes = read_file(path, kHeaderBytes + kMaxData, "pipeline cache");
  CacheBytes data = bytes ? trusted_data(*bytes, state.identity) : CacheBytes{};
  VkPipelineCache cache = VK_NULL_HANDLE;
  VkResult made = create_cache(state, data, cache);
  if (made != VK_SUCCESS && !data.empty()) made = create_cache(state, data = {}, cache);  // it may have run out of memory for them
  RG_TRY(check(made, "vkCreatePipelineCache", path));
  file.path = path;
  file.cache = UniquePipelineCache(state.vk, state.device, cache);
  file.loaded_bytes = data.size();
  file.kept = data.empty() ? 0 : plan_file::checksum(data);
  state.pipeline_cache = cache;
  return Done{};
}

Status save_pipeline_cache(Device::State& state, bool even_if_known) {
  PipelineCacheFile& file = state.cache_file;
  const auto get = [&](size_t& size, void* data) { return state.vk.GetPipelineCacheData(state.device, file.cache.get(), &size, data); };
  size_t size = 0;
  RG_TRY(check(get(size, nullptr), "vkGetPipelineCacheData", file.path));
  size = std::min(size, kMaxData);
  const std::unique_ptr<std::byte[]> memory(new (std::nothrow) std::byte[size]);
  if (!memory) return Error{ErrorCode::out_of_memory, "`" + file.path + "`: there is no memory for " + std::to_string(size) + " bytes of pipelines"};
  const VkResult got = get(size, memory.get());
  if (got != VK_INCOMPLETE)
    RG_TRY(check(got, "vkGetPipelineCacheData", file.path));  // a part is a cache, too: it has grown meanwhile, or is too long
  const CacheBytes data(memory.get(), size);
  const uint64_t checksum = plan_file::checksum(data);
  const std::lock_guard lock(file.mutex);
  if (!even_if_known && checksum == file.kept) return Done{};
  const auto header = header_of(data, checksum, state.identity);
  const CacheBytes parts[] = {header, data};
  RG_TRY(replace_file(file.path, parts));
  file.kept = checksum;
  return Done{};
}

}  // namespace rg
