#include "experiments/faults/object_imports.h"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

namespace presa::faults {
namespace {

/// Reads a T from a file's bytes; zeros beyond the end.
template <class T>
T at(const std::string& file, std::size_t offset) {
  T value{};
  if (offset + sizeof value <= file.size()) std::memcpy(&value, file.data() + offset, sizeof value);
  return value;
}

/// Undefined symbols in the dynamic symbol table of an ELF file.
std::vector<std::string> undefinedIn(const std::string& file) {
  std::vector<std::string> names;
  const auto head = at<ElfW(Ehdr)>(file, 0);
  for (std::size_t s = 0; s < head.e_shnum; ++s) {
    const auto section = at<ElfW(Shdr)>(file, head.e_shoff + s * head.e_shentsize);
    if (section.sh_type != SHT_DYNSYM) continue;
    const auto strings = at<ElfW(Shdr)>(file, head.e_shoff + section.sh_link * head.e_shentsize);
    for (std::size_t i = 0; i < section.sh_size / sizeof(ElfW(Sym)); ++i) {
      const auto symbol = at<ElfW(Sym)>(file, section.sh_offset + i * sizeof(ElfW(Sym)));
      const std::size_t name = strings.sh_offset + symbol.st_name;
      if (symbol.st_shndx == SHN_UNDEF && name < file.size()) names.emplace_back(file.c_str() + name);
    }
  }
  return names;
}

int addObject(dl_phdr_info* info, std::size_t, void* objects) {
  const std::string name = std::filesystem::path(info->dlpi_name).filename().string();
  if (!name.starts_with("presa_") && !name.starts_with("libpresa_")) return 0;
  std::ifstream stream(info->dlpi_name, std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(stream), {}};
  static_cast<std::vector<ObjectImports>*>(objects)->push_back({name, undefinedIn(file)});
  return 0;
}

}  // namespace

std::vector<ObjectImports> loadedObjects() {
  std::vector<ObjectImports> objects;
  dl_iterate_phdr(addObject, &objects);
  return objects;
}

std::vector<std::string> wallClocksAmong(const std::vector<std::string>& symbols) {
  static constexpr std::array<std::string_view, 6> kClocks{
      "time", "gettimeofday", "ftime", "timespec_get", "localtime_r", "_ZNSt6chrono3_V212system_clock3nowEv"};
  std::vector<std::string> found;
  std::ranges::copy_if(symbols, std::back_inserter(found),
                       [](const std::string& symbol) { return std::ranges::find(kClocks, symbol) != kClocks.end(); });
  return found;
}

}  // namespace presa::faults
