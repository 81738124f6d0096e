#include "maker/weave_page.hpp"

#include "document/markup.hpp"

#include <fmt/format.h>

namespace hauberk::maker {
namespace {

constexpr const char* style =
    "body{font:15px/1.4 Helvetica,Arial,sans-serif;color:#222;max-width:60em;margin:1.5em auto;padding:0 1em}"
    "h1{font-size:1.5em}"
    ".states{display:flex;flex-wrap:wrap;gap:1em}"
    "figure{margin:0;width:17em}img{width:100%;border:1px solid #ddd}figcaption{font-size:.9em}"
    "pre{font:13px/1.45 'DejaVu Sans Mono',Menlo,Consolas,monospace;white-space:pre-wrap}"
    "@media print{body{margin:0;max-width:none}figure{width:30%}pre{font-size:7.5pt}}";

}  // namespace

std::string sheet_page(const Sheet& sheet, const std::vector<SheetPicture>& pictures)
{
  const std::string name = xml_escape(sheet.weave.name);
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{0}</title>\n<style>{1}</style>\n</head>\n"
      "<body>\n<h1>{0}</h1>\n",
      name, style);
  if (!pictures.empty()) out += "<div class=\"states\">\n";
  for (const SheetPicture& picture : pictures)
    out += fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
        xml_escape(picture.caption), base64(picture.png));
  if (!pictures.empty()) out += "</div>\n";
  return out +
         fmt::format("<pre>{}</pre>\n</body>\n</html>\n", xml_escape(sheet_text(sheet), LineBreaks::kept));
}

}  // namespace hauberk::maker
