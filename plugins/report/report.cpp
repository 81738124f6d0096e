#include "report/report.hpp"

namespace hauberk {

std::vector<NamedContent> report_content(std::span<const ReportEntry> entries)
{
  return {{report_table_file, report_csv(entries)},
          {report_picture_file, report_svg(entries)},
          {report_text_file, report_text(entries)}};
}

}  // namespace hauberk
