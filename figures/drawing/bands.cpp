#include "drawing/bands.hpp"

#include <vtkCamera.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTransform2D.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace antilock::figures {
namespace {

// Rows of the image that are read back at a time, and rows rendered below and above them: a thick
// line of a scene is cut off where its centre leaves the window.
constexpr int band_height = 150, margin = 5;
constexpr int rendered_rows = band_height + 2 * margin;

/// The item that VTK asks to paint itself: what reaches into the rows rendered from `from` on.
class Sheet : public vtkContextItem {
 public:
  static Sheet* New();
  vtkTypeMacro(Sheet, vtkContextItem) const std::vector<Painting>* pieces = nullptr;
  int height = 0, from = 0;
  bool Paint(vtkContext2D* painter) override {
    // A vtkContext2D puts 0.5 and n - 0.5 on the borders of a window of n pixels: here, on those of
    // the whole page.
    const double page = oversampling * height, rows = oversampling * rendered_rows;
    const double scale = (1 - 1 / rows) / (1 - 1 / page);
    vtkNew<vtkTransform2D> onto_rows;
    onto_rows->Translate(0, 0.5 - 0.5 * scale - (1 - 1 / rows) * oversampling * from);
    onto_rows->Scale(1, scale);
    painter->PushMatrix();
    painter->AppendTransform(onto_rows);
    for (const Painting& piece : *pieces)
      if (piece.high >= from - 1 && piece.low <= from + rendered_rows + 1) piece.paint(*painter);
    painter->PopMatrix();
    return true;
  }
};
vtkStandardNewMacro(Sheet);

/// Shows the part of a scene that lies in a band. All in pixels of the large image, whole ones, so
/// that every band shows what the whole page would.
class SceneInBands {
 public:
  SceneInBands(const Drawing3d& scene, int width)
      : renderer_(scene.renderer),
        scale_(scene.renderer->GetActiveCamera()->GetParallelScale()),
        left_(scene.where.x / width),
        right_(scene.where.right() / width),
        low_(std::lround(oversampling * scene.where.y)),
        high_(std::lround(oversampling * scene.where.top())) {}
  void show(long from, long rows) const {
    const long low = std::max(low_, from), high = std::min(high_, from + rows);
    renderer_->SetDraw(low < high);
    if (low >= high) return;
    const auto share = [&](long y) {
      return static_cast<double>(y - from) / static_cast<double>(rows);
    };
    renderer_->SetViewport(left_, share(low), right_, share(high));
    vtkCamera* camera = renderer_->GetActiveCamera();
    const auto shown = static_cast<double>(high - low);
    camera->SetParallelScale(scale_ * shown / static_cast<double>(high_ - low_));
    camera->SetWindowCenter(0, static_cast<double>(low + high - low_ - high_) / shown);
  }

 private:
  vtkRenderer* renderer_;
  double scale_, left_, right_;
  long low_, high_;
};

/// Averages squares of the large image (RGBA) into rows [from, to) of the image (RGB).
void average(const unsigned char* large, vtkImageData& image, int from, int to) {
  const int width = image.GetDimensions()[0];
  for (int y = from; y < to; ++y) {
    auto* out = static_cast<unsigned char*>(image.GetScalarPointer(0, y, 0));
    const unsigned char* square = large + 4L * oversampling * width * oversampling * (y - from);
    for (int x = 0; x < width; ++x, square += 4 * oversampling)
      for (int channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int i = 0; i < oversampling; ++i)
          for (int j = 0; j < oversampling; ++j)
            sum += square[4 * (i * oversampling * width + j) + channel];
        *out++ = static_cast<unsigned char>(sum / (oversampling * oversampling));
      }
  }
}

}  // namespace

vtkSmartPointer<vtkImageData> render_in_bands(const std::vector<Drawing3d>& scenes,
                                              const std::vector<Painting>& pieces, int width,
                                              int height) {
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SwapBuffersOff();  // what is read back is the back buffer
  window->SetSize(oversampling * width, oversampling * rendered_rows);
  window->SetNumberOfLayers(2);
  vtkNew<vtkRenderer> paper;
  paper->SetBackground(1, 1, 1);
  paper->InteractiveOff();
  window->AddRenderer(paper);
  std::vector<SceneInBands> shown;
  for (const Drawing3d& scene : scenes) {
    scene.renderer->SetBackground(1, 1, 1);
    window->AddRenderer(scene.renderer);
    shown.emplace_back(scene, width);
  }
  vtkNew<vtkRenderer> overlay;
  overlay->SetLayer(1);
  vtkNew<Sheet> sheet;
  sheet->pieces = &pieces;
  sheet->height = height;
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(sheet);
  actor->GetScene()->SetRenderer(overlay);
  overlay->AddActor(actor);
  window->AddRenderer(overlay);

  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkUnsignedCharArray> pixels;
  for (int from = 0; from < height; from += band_height) {
    sheet->from = from - margin;
    for (const SceneInBands& scene : shown)
      scene.show(oversampling * (from - margin), oversampling * rendered_rows);
    window->Render();
    // with alpha, as the driver holds them: three channels are packed one pixel at a time
    window->GetRGBACharPixelData(0, oversampling * margin, oversampling * width - 1,
                                 oversampling * (margin + band_height) - 1, 0, pixels);
    average(pixels->GetPointer(0), *image, from, std::min(from + band_height, height));
  }
  return image;
}

}  // namespace antilock::figures
