#include "maker/sheet_shape.hpp"
#include "maker/weave_comparison.hpp"
#include "maker/weave_page.hpp"
#include "maker/weave_roll.hpp"
#include "maker/weave_sheet.hpp"
#include "maker/wire_length.hpp"
#include "run/weave_library.hpp"

#include <hauberk/error.hpp>

#include <gtest/gtest.h>
#include <boost/json/array.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

namespace hauberk::maker {
namespace {

TEST(WireLength, IsReadInEveryUnit)
{
  EXPECT_DOUBLE_EQ(millimetres("8mm", "--inner"), 8.0);
  EXPECT_DOUBLE_EQ(millimetres(" 0.8 CM ", "--inner"), 8.0);
  EXPECT_DOUBLE_EQ(millimetres("5/16in", "--inner"), 7.9375);
  EXPECT_DOUBLE_EQ(millimetres("0.25\"", "--inner"), 6.35);
  // Printed tables: 18 AWG is 1.024 mm, 36 AWG 5 mil, 4/0 AWG 0.46 in; 18 SWG is 48 mil, 7/0 SWG half an
  // inch.
  EXPECT_NEAR(millimetres("18awg", "--wire"), 1.024, 5e-4);
  EXPECT_NEAR(millimetres("36awg", "--wire"), 0.127, 1e-12);
  EXPECT_NEAR(millimetres("4/0awg", "--wire"), 11.684, 1e-9);
  EXPECT_EQ(millimetres("0000awg", "--wire"), millimetres("4/0awg", "--wire"));
  EXPECT_NEAR(millimetres("18swg", "--wire"), 1.2192, 1e-12);
  EXPECT_NEAR(millimetres("7/0swg", "--wire"), 12.7, 1e-12);
  EXPECT_NEAR(millimetres("0swg", "--wire"), 8.2296, 1e-12);
}

TEST(WireLength, RefusesWhatIsNone)
{
  for (const char* text : {"", "8", "mm", "8furlong", "-8mm", "0mm", "1/0mm", "nanmm", "infmm", "1e400mm",
                           "18.5awg", "99swg", "8/0swg", "5/0awg"})
    EXPECT_THROW(millimetres(text, "--inner"), InputError) << text;
}

TEST(Rod, IsAsThickAsTheNearestRingLeaves)
{
  // A ring that lies flat below the axis is nearest where it crosses the plane through it.
  const Mat3 flat = Mat3::Identity();
  EXPECT_NEAR(distance_from_axis({1.0, 0.0, 0.0}, flat, 3.0, 7.0), 7.0, 1e-9);
  EXPECT_NEAR(distance_from_axis({1.0, 4.0, 0.0}, flat, 3.0, 7.0), std::hypot(1.0, 7.0), 1e-9);
  // One across the axis, beside it and around it.
  Mat3 across;
  across << 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  EXPECT_NEAR(distance_from_axis({0.0, 3.0, 3.0}, across, 3.0, 7.0), 5.0 - 3.0, 1e-9);
  EXPECT_NEAR(distance_from_axis({0.0, 0.0, 6.0}, across, 3.0, 7.0), 3.0 - 1.0, 1e-9);
  // A flat ring that the axis meets, in its plane.
  EXPECT_NEAR(distance_from_axis({0.0, 1.0, 7.0}, flat, 3.0, 7.0), 0.0, 1e-6);
}

class Answers : public ::testing::Test {
 protected:
  static WeaveLookup library()
  {
    return weave_lookup(".", std::filesystem::path(HAUBERK_SOURCE_DIR) / "share/weaves");
  }
  static std::shared_ptr<const Registry> registry()
  {
    const std::filesystem::path build = HAUBERK_BINARY_DIR;
    return std::make_shared<Registry>(std::vector<std::filesystem::path>{build / "lib/hauberk/plugins"});
  }
  static RingFit fit_of(const std::string& name)
  {
    return RingFit({read_weave(name, library()), library(), registry()});
  }
  static Sheet of(const std::string& name, double inner, double wire, double gap = 0.4,
                  std::optional<Ring> small = {})
  {
    Progress quiet(Progress::Mode::quiet);
    return answer(fit_of(name), {name, inner, wire, gap, false, small}, 2, quiet);
  }
};

TEST_F(Answers, OfAChainAreThoseOfTheClosedForm)
{
  const Sheet sheet = of("chain", 8.0, 1.2);
  ASSERT_EQ(sheet.ways.size(), 1U);
  // Taut, every ring sits in the next ones: two rings take two inner diameters.
  ASSERT_TRUE(sheet.ways[0].stretch);
  EXPECT_NEAR(sheet.ways[0].pitch * (1.0 + *sheet.ways[0].stretch), 16.0, 1e-8);
  // Pushed together it does not turn aside: rings of a kind lie side by side along it, a wire apart at least.
  ASSERT_TRUE(sheet.ways[0].compress);
  EXPECT_GT(sheet.ways[0].pitch * (1.0 + *sheet.ways[0].compress), 1.2 - 1e-8);
  // Surfaces that stay 0.4 mm apart take as much of each inner diameter.
  ASSERT_TRUE(sheet.printable);
  ASSERT_TRUE(sheet.with_gap[0].stretch);
  EXPECT_NEAR(sheet.with_gap[0].pitch * (1.0 + *sheet.with_gap[0].stretch), 15.2, 1e-8);
  // Two rings in every pitch of the rest, and the weight of their wire.
  EXPECT_NEAR(sheet.rings, 2000.0 / sheet.ways[0].pitch, 1e-9);
  EXPECT_NEAR(sheet.metal / sheet.rings, std::numbers::pi * 0.36 * std::numbers::pi * 9.2, 1e-11);
}

TEST(SheetShape, StrainAcrossIsThatAtRightAngles)
{
  LimitResult limit;
  limit.macro = {{"exx", 0.1}, {"eyy", -0.2}, {"exy", 0.05}};
  EXPECT_NEAR(strain_across(limit, 0.0), -0.2, 1e-15);
  EXPECT_NEAR(strain_across(limit, 90.0), 0.1, 1e-15);
  EXPECT_NEAR(strain_across(limit, 45.0), -0.1, 1e-15);
  EXPECT_NEAR(strain_across(limit, 135.0), 0.0, 1e-15);
}

/// Upright rings reach as high as their outer diameter, taut along the rows as at rest.
TEST_F(Answers, OfASheetTellWidthAndThickness)
{
  const Sheet sheet = of("japanese_4in1", 8.0, 1.2, 0.0);
  EXPECT_NEAR(sheet.thickness, 10.4, 1e-9);
  // Flat rings of one row are a pitch apart.
  EXPECT_GT(sheet.rest_gap, 0.0);
  EXPECT_LE(sheet.rest_gap, sheet.ways[0].pitch - 10.4 + 1e-9);
  const WayAnswer& rows = sheet.ways[0];
  ASSERT_TRUE(rows.stretch_thickness && rows.stretch_across && rows.compress_across);
  EXPECT_NEAR(*rows.stretch_thickness, 10.4, 1e-3) << "a small lean changes nothing at first order";
  // Pulled along a diagonal the squares close.
  const WayAnswer& diagonal = sheet.ways[1];
  EXPECT_GT(*diagonal.stretch, 0.3);
  EXPECT_LT(*diagonal.stretch_across, -0.3);
  EXPECT_TRUE(sheet.with_gap.empty());
  const std::string text = sheet_text(sheet);
  EXPECT_NE(text.find("the sheet at rest"), std::string::npos);
  EXPECT_EQ(text.find("printed"), std::string::npos) << "nobody prints it";
  EXPECT_EQ(of("chain", 8.0, 1.2, 0.0).thickness, 0.0);
}

/// The job of a sheet has the limits of its ways, as `hauberk run` writes them.
TEST_F(Answers, CarryTheResultsThatTheyRestOn)
{
  const Sheet sheet = of("japanese_4in1", 8.0, 1.2, 0.0);
  boost::json::object results;
  sheet.job->task->enter(results);
  const boost::json::array& limits = results.at("limits").as_array();
  ASSERT_EQ(limits.size(), 4U);
  EXPECT_EQ(limits[2].at("value").to_number<double>(), *sheet.ways[1].stretch);
  EXPECT_EQ(limits[3].at("value").to_number<double>(), *sheet.ways[1].compress);
  EXPECT_EQ(limits[0].at("poses").as_array().size(), sheet.job->prepared->scene.elements.size());
  EXPECT_FALSE(sheet.job->task->failed());
}

TEST_F(Answers, AsAPageStandAlone)
{
  Sheet sheet = of("chain", 8.0, 1.2, 0.0);
  sheet.weave.description = "a < b & c";
  const std::string page = sheet_page(sheet, {{"at rest <1>", std::string("\x89PNG\0", 5)}});
  EXPECT_NE(page.find("src=\"data:image/png;base64,iVBORwA=\""), std::string::npos);
  EXPECT_NE(page.find("<figcaption>at rest &lt;1&gt;</figcaption>"), std::string::npos);
  EXPECT_NE(page.find("chain: a &lt; b &amp; c\n"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);
}

TEST_F(Answers, OfSeveralWeavesAreOneTable)
{
  const Question question{"all", 8.0, 1.2, 0.0};
  std::vector<Compared> all(2);
  all[0].sheet = of("chain", 8.0, 1.2, 0.0);
  all[0].weave = all[0].sheet->weave;
  all[1].weave = read_weave("full_persian_6in1", library());
  all[1].why_not = "no room; take rings from 9 mm on";
  const std::string text = comparison_text(all, question);
  EXPECT_NE(text.find("ratio 6.667"), std::string::npos);
  EXPECT_NE(text.find("chain                  2.000  along the chain"), std::string::npos) << text;
  EXPECT_NE(text.find("full_persian_6in1      5.051  no room; take rings from 9 mm on"), std::string::npos)
      << text;
  const boost::json::array documents = comparison_json(all);
  EXPECT_EQ(documents[0].at("ways").as_array().size(), 1U);
  EXPECT_EQ(documents[1].at("why_not"), "no room; take rings from 9 mm on");
}

TEST_F(Answers, OfASquareWeaveHangAlongItsRowsLikeChains)
{
  const Sheet sheet = of("japanese_4in1", 8.0, 2.4, 0.9);
  EXPECT_EQ(sheet.ways[0].name, "along the rows");
  ASSERT_TRUE(sheet.ways[0].stretch);
  EXPECT_NEAR(sheet.ways[0].pitch * (1.0 + *sheet.ways[0].stretch), 16.0, 1e-7);
  // (8 - 0.9)/(2.4 + 0.9) is less than 1 + sqrt 2.
  EXPECT_FALSE(sheet.printable);
  EXPECT_TRUE(sheet.with_gap.empty());
  EXPECT_NE(sheet_text(sheet).find("has no room"), std::string::npos);
  const boost::json::object document = sheet_json(sheet);
  EXPECT_EQ(document.at("printable"), false);
  EXPECT_EQ(document.at("ways").as_array().size(), 2U);
}

TEST_F(Answers, OfTwoSizesOfRingsSayWhichFit)
{
  const RingFit fit = fit_of("dragonscale");
  const Question question{"dragonscale", 8.6, 1.4, 0.4, false, Ring{5.6, 1.3}};
  EXPECT_TRUE(fit.fits(question));
  const std::optional<Range> small = fit.fitting(question).small_inner;
  ASSERT_TRUE(small);
  // A small ring touches the large one around it where its outer diameter is the inner one of that; thin wire
  // of the small rings leaves the large ones to each other, at the ratio of the file.
  EXPECT_NEAR(small->high, 8.6 - 2.0 * 1.3, 2e-6 * 5.6);
  const std::optional<Range> wire = fit.fitting({"dragonscale", 8.6, 1.4, 0.4, false, Ring{6.2, 0.8}}).wire;
  ASSERT_TRUE(wire);
  EXPECT_NEAR(wire->high, 8.6 / 5.70924, 2e-6 * 1.4);
  // Ends are where the weave begins to have no room.
  for (const double end : {small->low, small->high}) {
    const double within = end == small->low ? 1e-3 : -1e-3;
    EXPECT_TRUE(fit.fits({"dragonscale", 8.6, 1.4, 0.4, false, Ring{end + within, 1.3}})) << end;
    EXPECT_FALSE(fit.fits({"dragonscale", 8.6, 1.4, 0.4, false, Ring{end - within, 1.3}})) << end;
  }
  // Also as they are printed.
  const std::string words = fitting_text(fit.fitting(question));
  const std::size_t at = words.find("small rings from ");
  ASSERT_NE(at, std::string::npos) << words;
  double low = 0.0, high = 0.0;
  ASSERT_EQ(std::sscanf(words.c_str() + at, "small rings from %lf to %lf", &low, &high), 2) << words;
  for (const double end : {low, high})
    EXPECT_TRUE(fit.fits({"dragonscale", 8.6, 1.4, 0.4, false, Ring{end, 1.3}})) << end;
  // What has no room has the nearest sizes told, or none.
  const Question wide{"dragonscale", 8.6, 1.4, 0.4, false, Ring{7.0, 1.3}};
  EXPECT_FALSE(fit.fits(wide));
  EXPECT_NEAR(fit.fitting(wide).small_inner->high, small->high, 2e-6 * 7.0);
  EXPECT_FALSE(fit.fitting({"dragonscale", 8.6, 3.0, 0.4, false, Ring{5.6, 1.3}}).small_inner);
  const Sheet sheet = of("dragonscale", 8.6, 1.2, 0.1, Ring{5.6, 1.1});
  ASSERT_EQ(sheet.ways.size(), 2U);
  EXPECT_TRUE(sheet.ways[0].stretch && sheet.ways[1].stretch);
  // Half of the rings are large.
  const double square = std::numbers::pi * std::numbers::pi;
  EXPECT_NEAR(sheet.metal / sheet.rings, square * (0.36 * 4.9 + 0.3025 * 3.35), 1e-11);
  EXPECT_NE(sheet_text(sheet).find("ratios 7.167 and 5.091"), std::string::npos);
}

TEST_F(Answers, CanBeWovenFromTheSmallestRatioOn)
{
  const RingFit fit = fit_of("european_4in1");
  EXPECT_TRUE(fit.fits({"european_4in1", 2.9810, 1.0, 0.4}));
  EXPECT_FALSE(fit.fits({"european_4in1", 2.9809, 1.0, 0.4}));
  EXPECT_TRUE(fit.fits({"european_4in1", 3.578, 1.2, 0.4})) << "as printed";
  EXPECT_EQ(fitting_text(fit.fitting({"european_4in1", 3.0, 1.2, 0.4})),
            "rings from 3.578 mm on, or wire up to 1.006 mm");
  EXPECT_THROW(fit_of("threefold"), InputError);
  EXPECT_THROW(fit_of("no_such_weave"), InputError);
}

/// A faulty file of two sizes is not taken for rings that do not fit.
TEST_F(Answers, OfTwoSizesNameWhatIsWrongInTheirFile)
{
  std::string error;
  const std::string whole = library()("dragonscale", error).value();
  const auto told = [&](const std::string& what, const std::string& instead) {
    std::string text = whole;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), instead);
    const WeaveLookup lookup = [text](const std::string&, std::string&) { return std::optional(text); };
    try {
      const RingFit fit({read_weave("own", lookup), lookup, registry()});
    } catch (const InputError& wrong) {
      return std::string(wrong.what());
    }
    return std::string();
  };
  EXPECT_EQ(told("5.6", "5.5"), "");
  EXPECT_NE(told("\"default\": 5.6, ", "").find("missing key 'default'"), std::string::npos);
  EXPECT_NE(told("\"torus_union\"", "\"torus_onion\"").find("torus_onion"), std::string::npos);
  EXPECT_NE(told("5.6", "7").find("overlap at rest"), std::string::npos);
  EXPECT_NE(told("small_wire_diameter\": {", "small_wire\": {").find("not woven of plain rings"),
            std::string::npos);
}

/// The volume of wire is that of rings.
TEST_F(Answers, OfOtherElementsAreRefused)
{
  std::string error;
  std::string text = library()("chain", error).value();
  const std::string ring = "\"tori\": [{ \"name\": \"ring\" }]";
  const std::size_t at = text.find(ring);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, ring.size(),
               "\"tori\": [{ \"name\": \"ring\" }, { \"name\": \"other\", \"group\": \"ring\" }]");
  const WeaveLookup lookup = [text](const std::string&, std::string&) { return std::optional(text); };
  const RingFit fit({read_weave("own", lookup), lookup, registry()});
  Progress quiet(Progress::Mode::quiet);
  EXPECT_THROW(answer(fit, {"own", 8.0, 1.2, 0.4}, 1, quiet), InputError);
}

}  // namespace
}  // namespace hauberk::maker
