#include "assertions.hpp"

#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "errors.hpp"

namespace pydart2 {

namespace {

[[noreturn]] void failed(const char* assertion, const char* file, unsigned line, const char*)
{
  const std::string_view path(file);
  throw Error(
      Kind::engine,
      "the engine cannot go on: it expects " + std::string(assertion) + " ("
          + std::string(path.substr(path.rfind('/') + 1)) + ":" + std::to_string(line) + ")");
}

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

  /// Lets the library's calls of `name` go to `target`.
  void redirect(const char* name, void* target) const
  {
    for (std::size_t i = 0; i < num_imports; ++i)
      if (const auto& symbol = symbols[imports[i].r_info >> 32]; std::strcmp(strings + symbol.st_name, name) == 0)
        write(base + imports[i].r_offset, target);
  }

  /// Writes into the table, which may be read-only since loading and is so again afterwards.
  void write(ElfW(Addr) place, void* target) const
  {
    const bool read_only = place >= read_only_begin && place < read_only_end;
    const auto size = static_cast<ElfW(Addr)>(sysconf(_SC_PAGESIZE));
    auto* page = reinterpret_cast<void*>(place & ~(size - 1));
    if (read_only && mprotect(page, size, PROT_READ | PROT_WRITE) != 0)
      return; // the assertion ends the process, as without this
    *reinterpret_cast<void**>(place) = target;
    if (read_only)
      mprotect(page, size, PROT_READ);
  }
};

bool is_of_the_engine(std::string_view path)
{
  const auto name = path.substr(path.rfind('/') + 1);
  for (const std::string_view prefix : {"libdart", "libfcl", "libode", "_pydart2_api"})
    if (name.substr(0, prefix.size()) == prefix)
      return true;
  return false;
}

/// The engine's LCP solver calls it after a message of its own.
[[noreturn]] void aborted()
{
  throw Error(Kind::engine, "the engine cannot go on; its last message says why");
}

int visit(dl_phdr_info* info, std::size_t, void*)
{
  if (is_of_the_engine(info->dlpi_name)) {
    const Library library(*info);
    library.redirect("__assert_fail", reinterpret_cast<void*>(&failed));
    library.redirect("abort", reinterpret_cast<void*>(&aborted));
  }
  return 0;
}

} // namespace

void make_assertions_throw()
{
  dl_iterate_phdr(&visit, nullptr);
}

} // namespace pydart2
