/// The document and the picture of a transition.

#include "tasks/transition/transition_results.hpp"

#include <gtest/gtest.h>
#include <boost/json/value.hpp>

namespace hauberk {
namespace {

TransitionResult sample()
{
  TransitionResult result;
  result.activation_distance = 0.1;
  result.range = 0.3;
  result.eigenvalue_threshold = 1e-3;
  result.length_unit = "mm";
  TransitionPath path;
  path.name = "a <turn>";
  path.axis = "rotation (degrees)";
  path.rotates = true;
  for (int k = 0; k < 3; ++k) {
    TransitionSample s;
    s.s = 0.5 * k;
    s.degrees = -1.0 + k;
    s.minima.resize(k == 1 ? 2 : 1);
    for (std::size_t i = 0; i < s.minima.size(); ++i) {
      s.minima[i].contact = k == 2 ? 1 : static_cast<int>(i);
      s.minima[i].distance = 0.08;
      s.minima[i].eigenvalue = 2e-3;
    }
    s.forces.resize(2);
    s.forces[0].energy = k;
    path.samples.push_back(s);
  }
  path.curves.resize(2);
  path.curves[0].contact = path.curves[0].formulation = "nearest";
  path.curves[0].energy = {0.25, 0.75, 1e-9};
  path.curves[1].contact = "auto";
  path.curves[1].formulation = "arc";
  path.curves[1].quadrature = {1e-9, 2e-9};
  result.paths.push_back(path);
  return result;
}

TEST(Transition, DocumentHasWhatCanBeExpected)
{
  const boost::json::value document = transition_json(sample());
  EXPECT_EQ(document.at_pointer("/paths/0/curves/0/energy_jump/relative").as_double(), 0.25);
  EXPECT_EQ(document.at_pointer("/paths/0/curves/1/formulation").as_string(), "arc");
  EXPECT_EQ(document.at_pointer("/paths/0/curves/1/quadrature_error/force").as_double(), 2e-9);
  EXPECT_TRUE(document.at_pointer("/paths/0/curves/0/quadrature_error").is_null());
  EXPECT_EQ(document.at_pointer("/paths/0/most_minima").to_number<int>(), 2);
  EXPECT_EQ(document.at_pointer("/paths/0/contacts/1/from").as_double(), 0.5);
  EXPECT_EQ(document.at_pointer("/paths/0/samples/1/minima/1/contact").to_number<int>(), 1);
}

TEST(Transition, PictureTellsLinesApartByDashes)
{
  const std::string text = transition_svg(sample(), "a & b");
  EXPECT_NE(text.find("a &amp; b"), std::string::npos);
  EXPECT_NE(text.find("a &lt;turn&gt;"), std::string::npos);
  for (const char* word : {"contact 0", "contact 1", "nearest", "auto (here arc)", "activation distance",
                           "rotation (degrees)", "contact energy"})
    EXPECT_NE(text.find(word), std::string::npos) << word;
  EXPECT_NE(text.find("stroke-dasharray=\"8,4\""), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(transition_svg(sample(), "a & b"), text);
}

}  // namespace
}  // namespace hauberk
