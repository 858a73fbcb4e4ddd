// A folder of results that need not be computed again: words of SPIR-V by the digest of everything they depend on.
//
//   DIR/ab/ab12...ef   magic, key, size, payload, SHA-256 of all that
//
// Any number of processes may share a folder: entries are written beside their place and renamed, readers see all of one or none. An entry that is
// cut short, changed in any bit, or lies under another's name is noticed, removed and counted as damaged; the result is then computed as if it had
// never been there. Nothing here fails: a folder that cannot be used means misses. Thread-safe.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/shaders/sha256.h"
#include "compiler/shaders/spirv_tools.h"

namespace rg::compiler {

constexpr uint64_t kDefaultCacheBytes = uint64_t{512} << 20;

class ShaderCache {
 public:
  // Creates the folder when something is first stored.
  explicit ShaderCache(std::string folder, uint64_t limit_bytes = kDefaultCacheBytes);

  std::optional<std::vector<Words>> find(const Digest& key) const;
  void store(const Digest& key, const std::vector<Words>& modules) const;
  // Removes the entries that were used longest ago until at most nine tenths of the limit are in use; nothing if the limit is kept, or if
  // another process is at it. Also removes what killed writers left behind. Call it once, at the end of a build that stored something.
  void trim() const;

  struct Counts {
    uint64_t hits = 0, misses = 0, damaged = 0, stored = 0, failed = 0;  // failed: entries that could not be written
  };
  Counts counts() const;
  const std::string& folder() const { return folder_; }

 private:
  std::string path_of(const Digest& key) const;
  std::string folder_;
  uint64_t limit_bytes_;
  mutable std::atomic<uint64_t> hits_ = 0, misses_ = 0, damaged_ = 0, stored_ = 0, failed_ = 0;
};

// The payload of an entry, and back; nullopt if the text is not one. Exposed for tests.
std::string encode_modules(const std::vector<Words>& modules);
std::optional<std::vector<Words>> decode_modules(std::string_view payload);

}  // namespace rg::compiler
