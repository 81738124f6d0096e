#pragma once
/// A maker's answers as one page with pictures, to look at and to put on paper.

#include "maker/weave_sheet.hpp"

#include <string>
#include <vector>

namespace hauberk::maker {

/// A PNG file with what stands below it.
struct SheetPicture {
  std::string caption;
  std::string png;
};

/// An HTML file that needs no other: the pictures side by side, and the page for people (sheet_text) below.
std::string sheet_page(const Sheet& sheet, const std::vector<SheetPicture>& pictures);

}  // namespace hauberk::maker
