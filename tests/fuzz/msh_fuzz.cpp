// A Gmsh mesh: read to a mesh that can be searched, or refused.
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "polder/seepage/msh_reader.hpp"
#include "scratch.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polder;
  std::istringstream in(fuzz::text_of(data, size));
  try {
    const Mesh mesh = read_msh(in).mesh;
    fuzz::require(!mesh.triangles.empty() && mesh.region.size() == mesh.triangles.size());
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      for (const int node : mesh.triangles[t]) fuzz::require(node >= 0 && node < static_cast<int>(mesh.nodes.size()));
      fuzz::require(area(mesh, t) > 0 && std::isfinite(area(mesh, t)));
    }
    outline(mesh);
    MeshLocator(mesh).find(mesh.nodes.front());
  } catch (const std::invalid_argument&) {
    fuzz::refusals().add();  // with a message, as promised
  }
  return 0;
}
