#include "compiler/pass_cost.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compiler/expressions.h"
#include "compiler/parse_json.h"

namespace rg::compiler {
namespace {

// The part of an image's bytes that mips [mip, mip + mips) of `layers` layers make.
double share_of(const dsl::Resource& resource, const Range& range) {
  if (range.mips == resource.mips) return static_cast<double>(range.layers) / std::max(1u, resource.layers);
  const double whole = 1 - std::pow(0.25, resource.mips);
  const double part = std::pow(0.25, range.mip) - std::pow(0.25, range.mip + range.mips);
  return part / whole * range.layers / std::max(1u, resource.layers);
}

double bytes_touched(const Frame& frame, const dsl::Access& access) {
  const dsl::Resource& resource = frame.graph->resources[access.resource];
  const double bytes = static_cast<double>(frame.bytes[access.resource.value]);
  const double part = resource.kind == dsl::ResourceKind::image ? share_of(resource, resolved_range(resource, access)) : 1;
  return bytes * part * (access.mode == dsl::Mode::read || access.mode == dsl::Mode::write ? 1 : 2);
}

double elements_written(const Frame& frame, const dsl::Pass& pass) {
  double most = 0;
  for (const dsl::Access& access : pass.accesses)
    if (access.mode != dsl::Mode::read) most = std::max(most, bytes_touched(frame, access) / 4);
  return most;
}

// Known for direct dispatches; others run about once an element of what they write.
double invocations(const Frame& frame, const dsl::Pass& pass, std::span<const Expr> exprs, std::span<const int64_t> extents) {
  const dsl::Dispatch& dispatch = pass.dispatch;
  const bool known = dispatch.kind == dsl::DispatchKind::over || dispatch.kind == dsl::DispatchKind::groups;
  if (!known) return elements_written(frame, pass);
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = dispatch.size[axis].valid() ? static_cast<double>(evaluate(exprs, index_of(dispatch.size[axis]), extents)) : 1;
    count *= std::max(1.0, size) * (dispatch.kind == dsl::DispatchKind::groups ? dispatch.group[axis] : 1);
  }
  return count;
}

}  // namespace

std::vector<double> pass_costs(const Frame& frame, const std::map<std::string, double>& measured_us) {
  const std::vector<Expr> exprs = convert_expressions(*frame.program);
  const std::vector<int64_t> extents = initial_values(*frame.program);
  std::vector<double> costs;
  for (uint32_t i = 0; i < frame.passes.size(); ++i) {
    const dsl::Pass& pass = frame.pass(i);
    const auto measured = measured_us.find(pass.name);
    if (measured != measured_us.end()) {
      costs.push_back(std::max(1.0, measured->second * 1000));
      continue;
    }
    double bytes = 0;
    for (const dsl::Access& access : pass.accesses) bytes += bytes_touched(frame, access);
    costs.push_back(kLaunchNs + pass.work_share * std::max(bytes / kBytesPerNs, invocations(frame, pass, exprs, extents) / kInvocationsPerNs));
  }
  return costs;
}

Profile parse_profile(std::string_view text) {
  Profile profile;
  const auto object = parse_json_object(text, profile.wrong);
  if (!object) return profile;
  const nlohmann::json& json = *object;
  const auto wrong = [&](const char* why) {
    profile.wrong = why;
    return profile;
  };
  if (json.value("schema", nlohmann::json()) != "rgc-profile-1") return wrong("its schema is not `rgc-profile-1`");
  if (!json.contains("graph") || !json["graph"].is_string()) return wrong("it does not name its graph");
  if (!json.contains("passes_us") || !json["passes_us"].is_object()) return wrong("it has no object `passes_us`");
  profile.graph = json["graph"];
  for (const auto& [name, us] : json["passes_us"].items()) {
    if (!us.is_number() || !(us.get<double>() >= 0) || us.get<double>() > 1e9) return wrong("a pass takes no sensible time");
    profile.passes_us[name] = us;
  }
  return profile;
}

}  // namespace rg::compiler
