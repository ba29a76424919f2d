// check_image: is a PNG what a figure should be? 1800 pixels across at least, a white background,
// and something drawn on it. Run: check_image IMAGE.png
#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "check_image: one argument is accepted, the PNG file\n");
    return 2;
  }
  const vtkNew<vtkPNGReader> reader;
  if (reader->CanReadFile(argv[1]) == 0) {
    fmt::print(stderr, "check_image: {}: not a PNG file\n", argv[1]);
    return 1;
  }
  reader->SetFileName(argv[1]);
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const int* size = image->GetDimensions();
  const int channels = image->GetNumberOfScalarComponents();
  const auto* pixels = static_cast<const unsigned char*>(image->GetScalarPointer());
  long drawn = 0;
  std::vector<bool> seen(1 << 24);  // one per colour
  for (long i = 0; i < static_cast<long>(size[0]) * size[1]; ++i) {
    const unsigned char* p = pixels + i * channels;
    if (p[0] < 250 || p[1] < 250 || p[2] < 250) ++drawn;
    seen[(p[0] << 16) | (p[1] << 8) | p[2]] = true;
  }
  const auto colours = std::count(seen.begin(), seen.end(), true);
  const auto white = [&](int x, int y) { return pixels[(static_cast<long>(y) * size[0] + x) * channels] > 250; };
  // nothing is cut off: the frame of the picture is white all round
  bool frame = true;
  for (int x = 0; x < size[0]; ++x) frame = frame && white(x, 0) && white(x, size[1] - 1);
  for (int y = 0; y < size[1]; ++y) frame = frame && white(0, y) && white(size[0] - 1, y);
  const double share = static_cast<double>(drawn) / size[0] / size[1];
  fmt::print("{} x {} pixels, {:.1f} % drawn on, {} colours, {}\n", size[0], size[1], 100 * share, colours,
             frame ? "white frame" : "something touches the frame");
  // drawn lines alone cover one per cent; a blank or a black picture is far outside these
  return size[0] >= 1800 && share > 0.005 && share < 0.9 && colours > 8 && frame ? 0 : 1;
}
