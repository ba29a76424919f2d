#include "drawing/page.hpp"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPen.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <ostream>

#include "antilock/core/atomic_file.hpp"

namespace antilock::figures {
namespace {

unsigned char byte(double share) {
  return static_cast<unsigned char>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

/// Points as the context takes them: floats x, y, in pixels of the large image.
std::vector<float> enlarged(const std::vector<Point>& points) {
  std::vector<float> flat;
  for (const Point& p : points) {
    flat.push_back(static_cast<float>(oversampling * p.x));
    flat.push_back(static_cast<float>(oversampling * p.y));
  }
  return flat;
}

void set_brush(vtkContext2D& context, const Colour& colour, double opacity) {
  context.GetPen()->SetLineType(vtkPen::NO_PEN);
  context.GetBrush()->SetColor(byte(colour[0]), byte(colour[1]), byte(colour[2]), byte(opacity));
}

/// A thick line is painted as one quadrilateral per segment and one disc per joint: round joints,
/// on every driver.
void paint_line(vtkContext2D& context, const std::vector<Point>& points, double width,
                const Colour& colour) {
  set_brush(context, colour, 1);
  const double half = 0.5 * width;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point along = points[i + 1] - points[i];
    if (length(along) == 0) continue;
    const Point side = (half / length(along)) * Point{-along.y, along.x};
    auto quad =
        enlarged({points[i] + side, points[i + 1] + side, points[i + 1] - side, points[i] - side});
    context.DrawPolygon(quad.data(), 4);
    if (i > 0 && width > 2) {
      const auto centre = enlarged({points[i]});
      const auto radius = static_cast<float>(oversampling * half);
      context.DrawEllipse(centre[0], centre[1], radius, radius);
    }
  }
}

/// How far down and up these reach, with half the width of a line around them.
std::pair<double, double> reach(const std::vector<Point>& points, double half = 0) {
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](Point a, Point b) { return a.y < b.y; });
  return {low->y - half, high->y + half};
}

}  // namespace

void Page::line(const std::vector<Point>& points, const Stroke& stroke) {
  if (points.size() < 2) return;
  using Lines = std::vector<std::vector<Point>>;
  const Lines pieces = stroke.dashes.empty() ? Lines{points} : dashed(points, stroke.dashes);
  const auto [low, high] = reach(points, stroke.width);
  pieces_.push_back({low, high, [pieces, stroke](vtkContext2D& context) {
                       for (const auto& piece : pieces)
                         paint_line(context, piece, stroke.width, stroke.colour);
                     }});
}

void Page::rectangle(const Box& box, const Stroke& stroke) {
  line({{box.x, box.y},
        {box.right(), box.y},
        {box.right(), box.top()},
        {box.x, box.top()},
        {box.x, box.y},
        {box.x + 1, box.y}},
       stroke);
}

void Page::fill(const std::vector<Point>& corners, const Colour& colour, double opacity) {
  const auto [low, high] = reach(corners);
  pieces_.push_back(
      {low, high, [flat = enlarged(corners), colour, opacity](vtkContext2D& context) mutable {
         set_brush(context, colour, opacity);
         context.DrawPolygon(flat.data(), static_cast<int>(flat.size() / 2));
       }});
}

void Page::fill(const Box& box, const Colour& colour, double opacity) {
  fill({{box.x, box.y}, {box.right(), box.y}, {box.right(), box.top()}, {box.x, box.top()}}, colour,
       opacity);
}

void Page::marker(Point at, Marker shape, double size, const Colour& colour) {
  const auto scaled = [&](double diameter) {
    std::vector<Point> corners = outline(shape);
    for (Point& corner : corners) corner = at + (0.5 * diameter) * corner;
    return corners;
  };
  if (shape == Marker::cross) {
    const auto corners = scaled(size);
    line({corners[0], corners[2]}, {7, colour});
    line({corners[1], corners[3]}, {7, colour});
    return;
  }
  fill(scaled(size + 4), palette::white);
  fill(scaled(size), colour);
}

void Page::arrow(Point from, Point to, const Stroke& stroke) {
  const Point along = (1 / length(to - from)) * (to - from), side{-along.y, along.x};
  const double head = 5 * stroke.width + 8;
  line({from, to - (0.8 * head) * along}, stroke);
  fill({to, to - head * along + (0.4 * head) * side, to - head * along - (0.4 * head) * side},
       stroke.colour);
}

void Page::text(Point at, const std::string& markup, const TextStyle& style) {
  if (!markup.empty()) texts_.push_back({at, markup, style});
}

void Page::scene(vtkSmartPointer<vtkRenderer> renderer, const Box& where) {
  scenes_.push_back({std::move(renderer), where});
}

std::vector<LaidText> Page::laid_texts() const {
  std::vector<LaidText> laid;
  for (const Text& text : texts_)
    laid.push_back(
        {text.markup, typesetter_.extent(text.at, text.markup, text.style), text.style.most});
  return laid;
}

std::optional<std::string> Page::layout_fault() const {
  return figures::layout_fault(laid_texts(), width, height_);
}

double Page::smallest_type() const { return figures::smallest_type(laid_texts(), width); }

void Page::save(const std::filesystem::path& path, int compression, bool half) const {
  const vtkSmartPointer<vtkImageData> image = render_in_bands(scenes_, pieces_, width, height_);
  for (const Text& text : texts_) typesetter_.draw(*image, text.at, text.markup, text.style);

  vtkNew<vtkPNGWriter> writer;
  vtkNew<vtkImageShrink3D> halves;  // means over 2 x 2 pixels
  halves->SetInputData(image);
  halves->SetShrinkFactors(2, 2, 1);
  if (half)
    writer->SetInputConnection(halves->GetOutputPort());
  else
    writer->SetInputData(image);
  writer->SetCompressionLevel(compression);
  writer->WriteToMemoryOn();
  writer->Write();
  const vtkUnsignedCharArray* bytes = writer->GetResult();
  write_file(path, [&](std::ostream& out) {
    out.write(
        reinterpret_cast<const char*>(const_cast<vtkUnsignedCharArray*>(bytes)->GetPointer(0)),
        static_cast<std::streamsize>(bytes->GetNumberOfValues()));
  });
}

}  // namespace antilock::figures
