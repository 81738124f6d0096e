#include "results/timings.hpp"

#include "document/json_text.hpp"
#include "document/json_writer.hpp"

#include <gtest/gtest.h>

namespace hauberk {
namespace {

namespace json = boost::json;

constexpr const char* sample = R"({
  "format": "hauberk-results/2",
  "experiment": { "design": { "published": { "seconds": 3 } } },
  "provenance": { "version": "1", "threads": 2, "peak_memory_bytes": 5000000, "seed": 1 },
  "plan": { "seconds": 4 },
  "limits": [ { "value": 0.1, "seconds": 0.25, "min_gap": 1e-9 }, { "value": null, "seconds": null } ],
  "chart": { "points": [ { "seconds": { "runs": [1] } } ], "reference": { "seconds": 2 } },
  "sweep": { "rows": [ { "result": { "limits": [ { "seconds": 1.5, "a/b~": { "seconds": 7 } } ] } } ] },
  "design": { "seconds": 9, "history": [ { "seconds": 1, "values": [] } ] }
})";

json::value parsed() { return parse_json(sample, "sample"); }

TEST(Timings, AreTakenOutAndPutBack)
{
  json::value document = parsed();
  const json::object timings = take_timings(document.as_object());
  EXPECT_EQ(write_json(timings), write_json(parse_json(R"({
    "format": "hauberk-timings/1", "threads": 2, "peak_memory_bytes": 5000000,
    "seconds": { "/limits/0": 0.25, "/limits/1": null, "/sweep/rows/0/result/limits/0": 1.5,
                 "/sweep/rows/0/result/limits/0/a~1b~0": 7, "/design": 9, "/design/history/0": 1 } })",
                                                       "expected")));
  std::string keys;
  for (const auto& [key, value] : document.at_pointer("/limits/0").as_object())
    keys += std::string(key) + ' ';
  EXPECT_EQ(keys, "value min_gap ") << "in their order";
  EXPECT_EQ(document.at_pointer("/chart"), parsed().at_pointer("/chart"))
      << "the times of a chart are its data";
  EXPECT_EQ(document.at("experiment"), parsed().at("experiment"));
  EXPECT_EQ(document.at("plan"), parsed().at("plan"));
  EXPECT_FALSE(document.at("provenance").as_object().contains("threads"));

  enter_timings(document, timings);
  EXPECT_EQ(document, parsed()) << "up to the order of members";
}

TEST(Timings, DamagedOnesAreLeftOut)
{
  json::value document = parsed();
  (void)take_timings(document.as_object());
  const json::value without = document;
  for (
      const char* damaged :
      {"[]", "{}", R"({ "format": "hauberk-timings/9", "seconds": { "/limits/0": 1 } })",
       R"({ "format": "hauberk-timings/1", "seconds": [1] })",
       R"({ "format": "hauberk-timings/1", "threads": "many", "peak_memory_bytes": -4 })",
       R"({ "format": "hauberk-timings/1", "seconds": { "/limits/7": 1, "limits": 1, "/limits": 1, "/limits/-": 1,
             "/limits/0": "x", "/limits/1": -1, "/limits/0/value": 2 } })"}) {
    enter_timings(document, parse_json(damaged, "damaged"));
    EXPECT_EQ(document, without) << damaged;
  }
}

}  // namespace
}  // namespace hauberk
