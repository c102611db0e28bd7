#include "meshfile/load.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

#include "base/memory.hpp"
#include "base/place.hpp"
#include "meshfile/formats.hpp"
#include "reader/process.hpp"

namespace dotyk::meshfile {
namespace {

using reader::output_of;

std::string ending(const std::string& file) {
  const auto dot = file.rfind('.');
  std::string result = dot == std::string::npos || file.find('/', dot) != std::string::npos ? "" : file.substr(dot);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string content(const std::string& file) {
  struct stat info {};
  if (stat(file.c_str(), &info) == 0) require_memory(3.0 * static_cast<double>(info.st_size), "reading '" + file + "'");
  std::ifstream in(file, std::ios::binary);
  std::string all{std::istreambuf_iterator<char>(in), {}};
  if (!in && !in.eof()) throw InputError("cannot read '" + file + "'");
  return all;
}

std::string gmsh_program() {
  return reader::require_program("dotyk_gmsh", "Gmsh's library: install it (apt-get install --no-install-recommends libgmsh-dev) "
                                               "and build again; meshes in .msh files are read without it");
}

/// A name that Gmsh and VTK cannot take for an option.
std::string plain(const std::string& file) { return file[0] == '/' ? file : "./" + file; }

Contents contents(const std::string& file, Monitor& monitor) {
  const std::string end = ending(file);
  if (end == ".mesh") return read_mfem(content(file), file);
  if (end == ".msh") return read_msh(content(file), file);
  return read(output_of(reader::require_program("dotyk_vtu", "VTK's library"), {plain(file)}, file, monitor));
}

/// With all its digits.
std::string exact(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

Loaded mesh_file(const std::string& file, const Meshing& meshing, const Choice& choice, const std::string& what, Monitor& monitor) {
  const std::vector<std::string> arguments{plain(file), std::to_string(meshing.dimension), exact(meshing.size), std::to_string(choice.order)};
  const std::string answer = output_of(gmsh_program(), arguments, what, monitor,
                                       "does a loop in the geometry not end, or is the mesh to be far too fine?");
  if (answer.empty()) throw InputError(what + ": Gmsh ended without a mesh; does the geometry say Exit?");  // which ends the program
  return assemble(read_msh(answer, what), choice, what);
}

/// A text as a file in memory, which the programs that this one starts can open by its name.
class TextFile {
 public:
  explicit TextFile(const std::string& text) : file_(memfd_create("geometry", 0)) {
    if (const int low = file_; low >= 0 && low <= STDERR_FILENO) {  // the programs get new ones of these
      file_ = fcntl(low, F_DUPFD, STDERR_FILENO + 1);
      ::close(low);
    }
    if (file_ < 0 || ::write(file_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      throw std::runtime_error(std::string("the geometry's text cannot be handed over: ") + std::strerror(errno));
  }
  ~TextFile() { ::close(file_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  std::string name() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace

Loaded load(const std::string& file, const Choice& choice, Monitor& monitor) {
  const std::string end = ending(file);
  if (end == ".geo") throw InputError("'" + file + "' is a geometry: dotyk.mesh.gmsh{ file = \"" + file + "\" } meshes it");
  if (end != ".msh" && end != ".mesh" && end != ".vtu")
    throw InputError("'" + file + "' does not end in .msh (Gmsh), .mesh (MFEM) or .vtu (VTK)");
  require_readable(file);
  return assemble(contents(file, monitor), choice, file);
}

Loaded mesh_geometry(const std::string& file, const Meshing& meshing, const Choice& choice, Monitor& monitor) {
  static const std::string known[] = {".geo", ".step", ".stp", ".brep", ".iges", ".igs"};
  if (std::find(std::begin(known), std::end(known), ending(file)) == std::end(known))
    throw InputError("'" + file + "' does not end in .geo, .step, .stp, .brep, .iges or .igs");
  require_readable(file);
  if (ending(file) == ".geo" && content(file).back() != '\n')
    throw InputError(file + ": its last line does not end; without a newline there, Gmsh leaves out the last statements");
  return mesh_file(file, meshing, choice, file, monitor);
}

Loaded mesh_text(const std::string& geometry, const Meshing& meshing, const Choice& choice, Monitor& monitor) {
  const TextFile file(geometry + "\n");  // without a last newline Gmsh leaves out what comes last
  try {
    return mesh_file(file.name(), meshing, choice, "geometry", monitor);
  } catch (const InputError& e) {
    std::string message = e.what();
    const std::string name = "'" + file.name() + "'";
    for (std::size_t at; (at = message.find(name)) != std::string::npos;) message.replace(at, name.size(), "the text");
    throw InputError(message);
  }
}

}  // namespace dotyk::meshfile
