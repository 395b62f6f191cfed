#include "engine/import_table.hpp"

#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <string_view>

namespace pydart2 {

namespace {

/// One loaded library, as the dynamic linker sees it.
struct Library
{
  ElfW(Addr) base, read_only_begin = 0, read_only_end = 0;
  const ElfW(Sym)* symbols = nullptr;
  const char* strings = nullptr;
  const ElfW(Rela)* imports = nullptr;
  std::size_t num_imports = 0;

  explicit Library(const dl_phdr_info& info) : base(info.dlpi_addr)
  {
    for (int i = 0; i < info.dlpi_phnum; ++i) {
      const auto& header = info.dlpi_phdr[i];
      const auto begin = base + header.p_vaddr;
      if (header.p_type == PT_DYNAMIC)
        read(reinterpret_cast<const ElfW(Dyn)*>(begin));
      if (header.p_type == PT_GNU_RELRO) {
        read_only_begin = begin;
        read_only_end = begin + header.p_memsz;
      }
    }
  }

  void read(const ElfW(Dyn)* entry)
  {
    for (; entry->d_tag != DT_NULL; ++entry) {
      const auto address = entry->d_un.d_ptr;
      if (entry->d_tag == DT_SYMTAB)
        symbols = reinterpret_cast<const ElfW(Sym)*>(address);
      else if (entry->d_tag == DT_STRTAB)
        strings = reinterpret_cast<const char*>(address);
      else if (entry->d_tag == DT_JMPREL)
        imports = reinterpret_cast<const ElfW(Rela)*>(address);
      else if (entry->d_tag == DT_PLTRELSZ)
        num_imports = entry->d_un.d_val / sizeof(ElfW(Rela));
    }
  }

  /// Whether it imports `name`; then its calls go to `target`.
  bool redirect(const char* name, void* target) const
  {
    for (std::size_t i = 0; i < num_imports; ++i)
      if (const auto& symbol = symbols[imports[i].r_info >> 32]; std::strcmp(strings + symbol.st_name, name) == 0)
        return write(base + imports[i].r_offset, target);
    return false;
  }

  /// Writes into the table, which may be read-only since loading and is so again afterwards.
  bool write(ElfW(Addr) place, void* target) const
  {
    const bool read_only = place >= read_only_begin && place < read_only_end;
    const auto size = static_cast<ElfW(Addr)>(sysconf(_SC_PAGESIZE));
    auto* page = reinterpret_cast<void*>(place & ~(size - 1));
    if (read_only && mprotect(page, size, PROT_READ | PROT_WRITE) != 0)
      return false;
    *reinterpret_cast<void**>(place) = target;
    if (read_only)
      mprotect(page, size, PROT_READ);
    return true;
  }
};

struct Redirection
{
  std::initializer_list<const char*> prefixes;
  const char* name;
  void* target;
  int count = 0;

  bool concerns(std::string_view path) const
  {
    const auto file = path.substr(path.rfind('/') + 1);
    for (const std::string_view prefix : prefixes)
      if (file.substr(0, prefix.size()) == prefix)
        return true;
    return false;
  }
};

int visit(dl_phdr_info* info, std::size_t, void* data)
{
  auto& redirection = *static_cast<Redirection*>(data);
  if (redirection.concerns(info->dlpi_name))
    redirection.count += Library(*info).redirect(redirection.name, redirection.target) ? 1 : 0;
  return 0;
}

} // namespace

int redirect(std::initializer_list<const char*> prefixes, const char* name, void* target)
{
  Redirection redirection{prefixes, name, target};
  dl_iterate_phdr(&visit, &redirection);
  return redirection.count;
}

} // namespace pydart2
