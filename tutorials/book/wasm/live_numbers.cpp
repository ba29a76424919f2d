// What the page's live figure must say, by the library as it is compiled for this machine:
// one line of JSON per question, with its element, mesh, 1/h, epsilon and numbers. Run:
// live_numbers
#include <fmt/format.h>

#include "live_figure.hpp"

using namespace antilock;

int main() {
  struct Kind {
    const char* name;
    book::LiveMesh mesh;
    double amount;
  };
  const Kind kinds[] = {{"structured", book::LiveMesh::structured, 0},
                        {"unstructured", book::LiveMesh::unstructured, 0},
                        {"moved", book::LiveMesh::moved, 0.1},
                        {"layered", book::LiveMesh::layered, 0}};
  for (const int cells : {8, 16})
    for (const Kind& kind : kinds)
      for (const Element* element : {&p1(), &crouzeix_raviart()}) {
        book::LiveFigure figure(kind.mesh, cells, kind.amount, *element);
        for (const double exponent : {0., -2., -6., -8.}) {
          const double epsilon = exponent == -8 ? 0 : std::pow(10, exponent);
          const book::LiveNumbers n = figure.solve(epsilon, book::LiveExact(epsilon));
          fmt::print(
              "{{\"element\": \"{}\", \"mesh\": \"{}\", \"moved\": {}, \"cells\": {}, "
              "\"exponent\": {}, ",
              element->name(), kind.name, kind.amount, cells, exponent);
          fmt::print("\"kept\": {:.17g}, \"error\": {:.17g}, \"touching\": {}, ",
                     100 * n.largest_on_contact / n.ridge, n.error, n.touching);
          std::string warning = figure.warning();  // its quotes, as JSON has them
          for (std::size_t at = 0; (at = warning.find('"', at)) != std::string::npos;
               at += 2)
            warning.insert(at, 1, '\\');
          fmt::print("\"largest\": {:.17g}, \"warning\": \"{}\"}}\n", n.largest_on_contact,
                     warning);
        }
      }
}
