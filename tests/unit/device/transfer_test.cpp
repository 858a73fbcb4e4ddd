#include "tests/unit/device/fixture.h"

namespace rg {
namespace {

using Transfers = test::DeviceTest;

TEST_F(Transfers, ClearAndCopyBringTheColourBack) {
  RG_OPEN_DEVICE(device, true);
  test::ClearAndCopy t = test::clear_and_copy();
  Result<GraphInstance> graph = GraphInstance::create(device, t.plan.view(), {});
  ASSERT_TRUE(graph) << graph.error().message;
  for (int frame = 0; frame < 4; ++frame) {
    RG_ASSERT_OK(graph->execute({}));
    const auto bytes = graph->readback(t.result);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(test::as<uint32_t>(*bytes), std::vector<uint32_t>(32, 0xffff00ffu));
  }
  EXPECT_EQ(device.validation_messages(), 0u) << all_messages();
}

}  // namespace
}  // namespace rg
