// The pipeline cache of a device of the runtime's own, kept in a file between runs.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <string>

#include "runtime/device.h"
#include "runtime/handles.h"

namespace rg {

// What a driver takes a cache from: itself alone.
struct CacheIdentity {
  uint32_t vendor = 0, device = 0, driver = 0;
  std::array<uint8_t, VK_UUID_SIZE> uuid{};
};

struct PipelineCacheFile {
  std::string path;  // empty: there is none
  UniquePipelineCache cache;
  uint64_t loaded_bytes = 0;  // of cache data that the file held and the driver was given
  uint64_t kept = 0;          // checksum of the data that the file holds, as far as this device knows
  std::mutex mutex;           // of `kept`
};

// After the device is made and described. Fails only where the driver can make no cache at all, not even an empty one.
Status open_pipeline_cache(Device::State& state, const std::string& path);
// `even_if_known`: also where the file is known to hold the same.
Status save_pipeline_cache(Device::State& state, bool even_if_known);

}  // namespace rg
