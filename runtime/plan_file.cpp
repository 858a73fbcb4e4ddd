#include "runtime/plan_file.h"

#include <sys/stat.h>

#include <bit>
#include <vector>

#include "runtime/errors.h"
#include "runtime/files.h"
#include "runtime/plan_check.h"
#include "runtime/plan_fields.h"

namespace rg {

struct PlanFile::State {
  std::string bytes;  // names point into it
  std::vector<std::vector<uint32_t>> modules;
  std::vector<std::shared_ptr<const void>> tables;  // std::vectors of rows
  std::vector<Plan> plans;
};

namespace {

using plan_file::PlanNumber;
using plan_file::PlanRow;
using plan_file::PlanTable;

// Takes values off the front of the bytes. After the first fault it gives zeros and empty tables.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  void keep_in(std::vector<std::shared_ptr<const void>>& tables, const std::vector<std::vector<uint32_t>>& modules) {
    tables_ = &tables, modules_ = &modules;
  }

  template <PlanNumber T>
  void get(T& value) {
    if constexpr (std::is_enum_v<T>) {
      std::underlying_type_t<T> number{};
      get(number);
      value = static_cast<T>(number);
    } else if constexpr (std::is_same_v<T, bool>) {
      const uint64_t number = take(1);
      if (number > 1) fail("a truth value that is neither 0 nor 1");
      value = number == 1;
    } else if constexpr (std::is_same_v<T, float>) {
      value = std::bit_cast<float>(static_cast<uint32_t>(take(4)));
    } else {
      value = static_cast<T>(take(sizeof(T)));
    }
  }
  void get(std::string_view& text) {
    const size_t size = count(1);
    text = rest_.substr(0, size);
    rest_.remove_prefix(size);
  }
  template <class T, size_t N>
  void get(T (&values)[N]) {
    for (T& value : values) get(value);
  }
  template <class T>
  void get(std::vector<T>& rows) {
    rows.resize(count(plan_file::least_bytes<T>()));
    for (T& row : rows) get(row);
  }
  template <class T>
  void get(std::span<const T>& rows) {
    auto table = std::make_shared<std::vector<T>>();
    get(*table);
    rows = *table;
    tables_->push_back(std::move(table));
  }
  void get(ShaderModule& module) {
    uint32_t index = 0;
    get(module.name), get(module.stage), get(index);
    if (index < modules_->size())
      module.words = (*modules_)[index];
    else
      fail("a shader without code");
  }
  template <PlanRow T>
  void get(T& row) {
    plan_file::each_field(row, [&](auto&... fields) { (get(fields), ...); });
  }

  void fail(const char* what) {
    if (fault_ == nullptr) fault_ = what;
    rest_ = {};
  }
  const char* fault() const { return fault_; }
  bool at_end() const { return rest_.empty(); }

 private:
  uint64_t take(size_t bytes) {
    if (rest_.size() < bytes) {
      fail("it ends too early");
      return 0;
    }
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; ++i) value |= uint64_t{static_cast<uint8_t>(rest_[i])} << 8 * i;
    rest_.remove_prefix(bytes);
    return value;
  }
  size_t count(size_t bytes_each) {
    const uint64_t rows = take(4);
    if (rows <= rest_.size() / bytes_each) return rows;
    fail("it ends too early");
    return 0;
  }

  std::string_view rest_;
  const char* fault_ = nullptr;
  std::vector<std::shared_ptr<const void>>* tables_ = nullptr;
  const std::vector<std::vector<uint32_t>>* modules_ = nullptr;
};

struct Header {
  uint32_t file_version = 0, plan_version = 0;
  uint64_t shape = 0, bytes = 0, checksum = 0;
};

// What is wrong with the file as a whole; empty: nothing.
std::string header_fault(std::string_view bytes) {
  if (!bytes.starts_with(plan_file::kMagic.substr(0, std::min(bytes.size(), plan_file::kMagic.size())))) return "it is no plan file";
  if (bytes.size() < plan_file::kHeaderBytes) return "it ends too early";
  Reader reader(bytes.substr(plan_file::kMagic.size()));
  Header header;
  reader.get(header.file_version), reader.get(header.plan_version), reader.get(header.shape), reader.get(header.bytes), reader.get(header.checksum);
  if (header.file_version != plan_file::kPlanFileVersion || header.plan_version != kPlanVersion || header.shape != plan_file::kPlanShape)
    return "it was written by another version of rgc (plans of version " + std::to_string(header.plan_version) +
           "); write it again with the rgc that this runtime came with";
  const std::string_view body = bytes.substr(plan_file::kHeaderBytes);
  if (body.size() < header.bytes) return "it ends too early";
  if (body.size() > header.bytes) return "something follows its end";
  return plan_file::checksum(body) == header.checksum ? "" : "its bytes are damaged";
}

constexpr size_t kMaxBytes = size_t{256} << 20;

}  // namespace

PlanFile::PlanFile(std::shared_ptr<const State> state) : state_(std::move(state)) {}

Result<PlanFile> PlanFile::parse(std::span<const std::byte> bytes, std::string_view name) {
  const auto refuse = [&](const std::string& why) { return Error{ErrorCode::invalid_plan, "`" + std::string(name) + "` is refused: " + why}; };
  auto state = std::make_shared<State>();
  state->bytes.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (const std::string fault = header_fault(state->bytes); !fault.empty()) return refuse(fault);
  Reader reader(std::string_view(state->bytes).substr(plan_file::kHeaderBytes));
  reader.keep_in(state->tables, state->modules);
  uint32_t modules = 0;
  reader.get(modules);
  for (uint32_t i = 0; i < modules && reader.fault() == nullptr; ++i) reader.get(state->modules.emplace_back());
  reader.get(state->plans);
  if (reader.fault() == nullptr && !reader.at_end()) reader.fail("something follows its last plan");
  if (reader.fault() != nullptr) return refuse(reader.fault());
  if (state->plans.empty()) return refuse("it holds no plan");
  for (const Plan& plan : state->plans)
    if (const Status checked = check_plan(plan); !checked) return refuse(checked.error().message);
  return PlanFile(std::move(state));
}

Result<PlanFile> PlanFile::read(const std::string& path) {
  const Result<std::vector<std::byte>> bytes = read_file(path, kMaxBytes, "plan file");
  if (!bytes) return bytes.error();
  return parse(*bytes, path);
}

std::span<const Plan> PlanFile::plans() const { return state_->plans; }

const Plan* PlanFile::find(std::string_view graph, std::string_view variant) const {
  for (const Plan& plan : state_->plans)
    if (plan.name == graph && plan.variant_name == variant) return &plan;
  return nullptr;
}

PlanWatch::PlanWatch(std::string path, bool report_first) : path_(std::move(path)) {
  if (!report_first) seen_ = look();
}

std::optional<PlanWatch::Mark> PlanWatch::look() const {
  struct stat about {};
  if (::stat(path_.c_str(), &about) != 0) return std::nullopt;
  return Mark{static_cast<uint64_t>(about.st_dev), static_cast<uint64_t>(about.st_ino), static_cast<uint64_t>(about.st_size),
              static_cast<int64_t>(about.st_mtim.tv_sec), static_cast<int64_t>(about.st_mtim.tv_nsec)};
}

std::optional<Result<PlanFile>> PlanWatch::poll() {
  const std::optional<Mark> now = look();
  if (!now || now == seen_) return std::nullopt;
  seen_ = now;
  return PlanFile::read(path_);
}

}  // namespace rg
