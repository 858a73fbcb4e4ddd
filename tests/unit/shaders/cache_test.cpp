// The cache under damage, many processes and sudden death.
#include "compiler/shaders/cache.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "compiler/shaders/sha256.h"

namespace rg::compiler {
namespace fs = std::filesystem;
namespace {

struct Cache : testing::Test {
  fs::path folder;
  Cache() {
    folder = fs::temp_directory_path() / ("rgc_cache_test_" + std::to_string(::getpid()));
    fs::remove_all(folder);
  }
  ~Cache() override { fs::remove_all(folder); }
  std::vector<fs::path> entries() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && entry.path().filename() != "lock") found.push_back(entry.path());
    return found;
  }
};

Digest key(uint64_t number) { return Sha256().add_number(number).finish(); }
std::vector<Words> modules(uint32_t number, size_t size = 100) { return {Words(size, number), Words(3, number + 1)}; }

std::string read_all(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
void write_all(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary | std::ios::trunc) << text; }

TEST(Sha256, KnownDigests) {
  EXPECT_EQ(hex(Sha256().finish()), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hex(Sha256().add("abc").finish()), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const std::string million(1'000'000, 'a');
  EXPECT_EQ(hex(Sha256().add(million).finish()), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  for (size_t cut = 0; cut < 200; ++cut)
    EXPECT_EQ(Sha256().add(million.substr(0, cut)).add(million.substr(cut, 130)).finish(), Sha256().add(million.substr(0, cut + 130)).finish());
  EXPECT_NE(Sha256().add_part("ab").add_part("c").finish(), Sha256().add_part("a").add_part("bc").finish());
}

TEST(Sha256, TheProcessorsInstructionsAndPortableCodeAgree) {
  const Sha256Blocks native = sha256_blocks_native();
  if (native == nullptr) GTEST_SKIP() << "this processor has no instructions for SHA-256";
  std::mt19937 random(1);
  std::vector<uint8_t> data(64 * 20);
  for (size_t blocks = 0; blocks <= 20; ++blocks) {
    Sha256State a, b;
    for (uint32_t& word : a) word = random();
    for (uint8_t& byte : data) byte = static_cast<uint8_t>(random());
    b = a;
    native(a, data.data(), blocks);
    sha256_blocks_portable(b, data.data(), blocks);
    EXPECT_EQ(a, b) << blocks << " blocks";
  }
}

TEST_F(Cache, GivesBackWhatItTook) {
  const ShaderCache cache(folder);
  EXPECT_EQ(cache.find(key(1)), std::nullopt);
  cache.store(key(1), modules(7));
  EXPECT_EQ(cache.find(key(1)), modules(7));
  EXPECT_EQ(cache.find(key(2)), std::nullopt);
  cache.store(key(3), {});
  EXPECT_EQ(cache.find(key(3)), std::vector<Words>{});
  EXPECT_EQ(cache.counts().hits, 2u);
  EXPECT_EQ(cache.counts().misses, 2u);
}

TEST_F(Cache, EveryFlippedBitAndEveryCutIsNoticed) {
  const ShaderCache cache(folder);
  cache.store(key(1), modules(7, 20));
  const fs::path entry = entries().at(0);
  const std::string whole = read_all(entry);
  uint64_t damaged = 0;
  const auto expect_damaged = [&](const std::string& text, const std::string& what) {
    write_all(entry, text);
    EXPECT_EQ(cache.find(key(1)), std::nullopt) << what;
    EXPECT_EQ(cache.counts().damaged, ++damaged) << what;
    EXPECT_FALSE(fs::exists(entry)) << what;
  };
  for (size_t bit = 0; bit < whole.size() * 8; ++bit) {
    std::string text = whole;
    text[bit / 8] = static_cast<char>(text[bit / 8] ^ (1 << (bit % 8)));
    expect_damaged(text, "bit " + std::to_string(bit));
  }
  for (size_t size = 0; size < whole.size(); ++size) expect_damaged(whole.substr(0, size), "cut to " + std::to_string(size));
  expect_damaged(whole + "x", "one byte more");
  write_all(entry, whole);
  EXPECT_EQ(cache.find(key(1)), modules(7, 20));
}

TEST_F(Cache, AnEntryUnderAnotherNameIsRefused) {
  const ShaderCache cache(folder);
  cache.store(key(1), modules(1));
  const fs::path one = entries().at(0);
  cache.store(key(2), modules(2));
  for (const fs::path& path : entries())
    if (path != one) fs::copy_file(one, path, fs::copy_options::overwrite_existing);
  EXPECT_EQ(cache.find(key(2)), std::nullopt);
  EXPECT_EQ(cache.counts().damaged, 1u);
  EXPECT_EQ(cache.find(key(1)), modules(1));
}

TEST_F(Cache, AFolderThatCannotBeUsedMeansMisses) {
  write_all(folder, "a file where the folder should be");
  const ShaderCache cache(folder);
  cache.store(key(1), modules(1));
  EXPECT_EQ(cache.find(key(1)), std::nullopt);
  cache.trim();
  EXPECT_EQ(cache.counts().failed, 1u);
}

TEST_F(Cache, OldEntriesGoFirst) {
  const ShaderCache cache(folder, 40'000);
  for (uint32_t i = 0; i < 20; ++i) {
    cache.store(key(i), modules(i, 1000));
    fs::last_write_time(folder / hex(key(i)).substr(0, 2) / hex(key(i)), fs::file_time_type::clock::now() - std::chrono::seconds(1000 - i));
  }
  cache.trim();
  uint64_t bytes = 0;
  for (const fs::path& path : entries()) bytes += fs::file_size(path);
  EXPECT_LE(bytes, 40'000u);
  EXPECT_GE(bytes, 30'000u);
  EXPECT_EQ(cache.find(key(0)), std::nullopt);
  EXPECT_EQ(cache.find(key(19)), modules(19, 1000));
}

// A process that stores and finds until it is told to stop or is killed; exits 1 if it ever reads something wrong.
[[noreturn]] void work(const fs::path& folder, uint32_t seed, uint32_t rounds) {
  const ShaderCache cache(folder, 200'000);
  std::mt19937 random(seed);
  for (uint32_t i = 0; i < rounds; ++i) {
    const auto number = static_cast<uint32_t>(random() % 40);
    const auto found = cache.find(key(number));
    if (found && *found != modules(number, 200 + number * 50)) ::_exit(1);
    if (!found) cache.store(key(number), modules(number, 200 + number * 50));
    if (i % 50 == 49) cache.trim();
  }
  ::_exit(cache.counts().damaged == 0 ? 0 : 2);
}

TEST_F(Cache, ManyProcessesShareOneFolder) {
  std::vector<pid_t> children;
  for (uint32_t i = 0; i < 12; ++i) {
    const pid_t child = ::fork();
    if (child == 0) work(folder, i, 400);
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  }
}

TEST_F(Cache, KilledWritersLeaveNothingWrong) {
  std::mt19937 random(1);
  for (uint32_t round = 0; round < 40; ++round) {
    const pid_t child = ::fork();
    if (child == 0) work(folder, round, UINT32_MAX);
    ::usleep(static_cast<useconds_t>(random() % 8000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it read something wrong: " << status;
  }
  const ShaderCache cache(folder);
  for (uint32_t number = 0; number < 40; ++number) {
    const auto found = cache.find(key(number));
    EXPECT_EQ(found.value_or(modules(number, 200 + number * 50)), modules(number, 200 + number * 50));
  }
  EXPECT_EQ(cache.counts().damaged, 0u);
}

TEST_F(Cache, AbandonedTemporaryFilesGo) {
  const ShaderCache cache(folder);
  cache.store(key(1), modules(1));
  const fs::path left = entries().at(0).parent_path() / ".tmp.1.1", fresh = entries().at(0).parent_path() / ".tmp.1.2";
  write_all(left, "half"), write_all(fresh, "half");
  fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::hours(2));
  cache.trim();
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(fresh));
}

TEST(CacheEntries, TextThatIsNoListOfModulesIsRefused) {
  const std::string good = encode_modules(modules(1));
  EXPECT_EQ(decode_modules(good), modules(1));
  for (size_t size = 0; size < good.size(); size += 3) EXPECT_EQ(decode_modules(good.substr(0, size)), std::nullopt);
  EXPECT_EQ(decode_modules(std::string(16, '\xff')), std::nullopt);
}

}  // namespace
}  // namespace rg::compiler
