/// `hauberk verify` on what `hauberk run` wrote, as it is and tampered with.

#include "document/json_text.hpp"
#include "program.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <functional>

namespace hauberk::test {
namespace {

namespace json = boost::json;

class Verify : public ::testing::Test {
 protected:
  static void SetUpTestSuite()
  {
    const WorkFolder folder;
    ASSERT_EQ(run_program({"run", folder.write("c.json", chain_text()), "-o", folder / "out"}).code, 0);
    results_ = read_results(folder / "out");
  }

  static Outcome verify(const std::function<void(json::value&)>& tamper)
  {
    json::value results = results_;
    tamper(results);
    const WorkFolder folder;
    return run_program({"verify", folder.write("results.json", write_json(results))});
  }

  static void scale(json::value& results, const std::string& pointer, double factor, double offset = 0.0)
  {
    results.at_pointer(pointer) = number_at(results, pointer) * factor + offset;
  }

  static void expect_caught(const std::function<void(json::value&)>& tamper)
  {
    const Outcome o = verify(tamper);
    EXPECT_EQ(o.code, 1) << o.out << o.err;
    EXPECT_EQ(o.out.find("FAIL /limits/0"), 0U) << o.out;
  }

  static inline json::value results_;
};

TEST_F(Verify, PassesAndSaysSoPerLimit)
{
  const Outcome o = verify([](json::value&) {});
  EXPECT_EQ(o.code, 0) << o.out;
  EXPECT_EQ(o.out.find("PASS /limits/0 (0 deg, stretch): "), 0U) << o.out;
  EXPECT_EQ(o.out.find("FAIL"), std::string::npos) << o.out;
}

TEST_F(Verify, CatchesAShiftedPose)
{
  expect_caught([](json::value& r) { scale(r, "/limits/0/poses/1/position/1", 1.0, 1e-3); });
}

TEST_F(Verify, CatchesAChangedForce)
{
  expect_caught([](json::value& r) { scale(r, "/limits/0/contacts/0/force", 1.01); });
}

TEST_F(Verify, CatchesAChangedValue)
{
  expect_caught([](json::value& r) { scale(r, "/limits/0/value", 1.0 + 1e-9); });
}

TEST_F(Verify, CatchesALostLink)
{
  expect_caught([](json::value& r) { scale(r, "/limits/0/poses/1/position/2", 1.0, 30.0); });
}

/// Cells of three vectors: every number that only they have is looked at.
TEST_F(Verify, Solids)
{
  const WorkFolder folder;
  ASSERT_EQ(run_program({"run", HAUBERK_SOURCE_DIR "/loadcases/volumetric_periodic/example.json", "-o",
                         folder / "out"})
                .code,
            0);
  const json::value results = read_results(folder / "out");
  const auto verified = [&](const std::function<void(json::value&)>& tamper) {
    json::value changed = results;
    tamper(changed);
    return run_program({"verify", folder.write("results.json", write_json(changed))});
  };
  const Outcome whole = verified([](json::value&) {});
  EXPECT_EQ(whole.code, 0) << whole.out;
  EXPECT_EQ(whole.out.find("FAIL"), std::string::npos) << whole.out;
  EXPECT_NE(whole.out.find("PASS /limits/3 ((1, 1, 1, 0, 0, 0), along)"), std::string::npos) << whole.out;

  const std::size_t contacts = results.at_pointer("/limits/2/contacts").as_array().size();
  std::size_t across = contacts;  // a contact with the next cell along z
  for (std::size_t k = 0; k < contacts; ++k) {
    const std::string pointer = "/limits/2/contacts/" + std::to_string(k) + "/image";
    if (results.at_pointer(pointer).as_array().size() == 3) across = k;
  }
  ASSERT_LT(across, contacts);
  const std::string image = "/limits/2/contacts/" + std::to_string(across) + "/image/2";
  const std::vector<std::function<void(json::value&)>> tampered{
      [](json::value& r) { scale(r, "/limits/2/macro/ezz", 1.0, 1e-4); },
      [](json::value& r) { scale(r, "/limits/2/macro/eyz", 1.0, 1e-4); },
      [](json::value& r) { scale(r, "/limits/2/macro/exz", 1.0, 1e-4); },
      [](json::value& r) { scale(r, "/limits/2/poses/3/position/2", 1.0, 1e-3); },
      [](json::value& r) { scale(r, "/limits/2/value", 1.0 + 1e-9); },
      [&](json::value& r) { r.at_pointer(image) = -r.at_pointer(image).to_number<std::int64_t>(); },
      [](json::value& r) { scale(r, "/limits/2/contacts/0/force", 1.01); }};
  for (std::size_t k = 0; k < tampered.size(); ++k) {
    const Outcome o = verified(tampered[k]);
    EXPECT_EQ(o.code, 1) << k << ": " << o.out;
    EXPECT_NE(o.out.find("FAIL /limits/2"), std::string::npos) << k << ": " << o.out;
  }
}

TEST_F(Verify, FilesThatAreNoResults)
{
  const WorkFolder folder;
  const Outcome other = run_program({"verify", folder.write("a.json", "{}")});
  EXPECT_EQ(other.code, 1);
  EXPECT_EQ(other.out.find("FAIL "), 0U) << other.out;
  const Outcome broken = run_program({"verify", folder.write("b.json", "{\n\"format\": ")});
  EXPECT_EQ(broken.code, 2);
  EXPECT_NE(broken.err.find(folder / "b.json"), std::string::npos) << broken.err;
  EXPECT_EQ(run_program({"verify", folder / "none.json"}).code, 2);
}

}  // namespace
}  // namespace hauberk::test
