/// Replays files through a harness, where libFuzzer is not there to do it: `fuzz_X FILE-OR-FOLDER...`.

#include "harness.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const fs::path& place)
{
  if (!fs::is_directory(place)) return {place};
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(place)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv)
{
  std::size_t count = 0;
  for (int k = 1; k < argc; ++k) {
    for (const fs::path& file : files_of(argv[k])) {
      std::ifstream in(file, std::ios::binary);
      const std::vector<char> text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
      if (!in) {
        std::fprintf(stderr, "%s: cannot be read\n", file.c_str());
        return 1;
      }
      // Before it runs: a crash is to say whose it is.
      std::printf("%s\n", file.filename().c_str());
      std::fflush(stdout);
      const std::vector<std::uint8_t> bytes(text.begin(), text.end());
      LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
      ++count;
    }
  }
  std::printf("%zu files\n", count);
  return count > 0 ? 0 : 1;
}
