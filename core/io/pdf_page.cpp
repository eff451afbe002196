#include "core/io/pdf_page.h"

#include <cairo/cairo-pdf.h>
#include <cairo/cairo.h>

#include <memory>
#include <numbers>

#include "core/io/jpeg.h"

namespace foresight {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;

struct Closer {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};

cairo_status_t AppendBytes(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void SelectFont(cairo_t* context, cairo_font_weight_t weight) {
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, weight);
}

/// The file keeps the surface as a JPEG, a tenth of its pixels' size; as they are where none can
/// be made.
void KeepAsJpeg(cairo_surface_t* surface, const ColorImage& image) {
  constexpr int kQuality = 90;  // the finest lines of outlines stay clean
  auto jpeg = EncodeJpeg(image, kQuality);
  if (!jpeg) return;
  auto kept = std::make_unique<std::string>(std::move(*jpeg));
  const cairo_status_t status = cairo_surface_set_mime_data(
      surface, CAIRO_MIME_TYPE_JPEG, reinterpret_cast<const unsigned char*>(kept->data()),
      kept->size(), [](void* text) { delete static_cast<std::string*>(text); }, kept.get());
  if (status == CAIRO_STATUS_SUCCESS) (void)kept.release();  // the surface deletes it
}

}  // namespace

struct PdfPage::Impl {
  std::string bytes;
  std::unique_ptr<cairo_surface_t, Closer> surface;
  std::unique_ptr<cairo_t, Closer> context;

  cairo_t* get() const { return context.get(); }
};

PdfPage::PdfPage(double width_mm, double height_mm) : impl_(std::make_unique<Impl>()) {
  impl_->surface.reset(cairo_pdf_surface_create_for_stream(
      AppendBytes, &impl_->bytes, width_mm * kPointsPerMm, height_mm * kPointsPerMm));
  cairo_pdf_surface_set_metadata(impl_->surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2026-01-01T00:00:00Z");
  impl_->context.reset(cairo_create(impl_->surface.get()));
  cairo_scale(impl_->get(), kPointsPerMm, kPointsPerMm);
  SelectFont(impl_->get(), CAIRO_FONT_WEIGHT_NORMAL);
  SetLineWidth(0.2);
}

PdfPage::~PdfPage() = default;

void PdfPage::SetColor(const Color& color) {
  cairo_set_source_rgb(impl_->get(), color.red, color.green, color.blue);
}

void PdfPage::SetLineWidth(double width_mm) {
  cairo_set_line_width(impl_->get(), width_mm);
}

void PdfPage::Fill(double x, double y, double width, double height) {
  cairo_rectangle(impl_->get(), x, y, width, height);
  cairo_fill(impl_->get());
}

void PdfPage::Frame(double x, double y, double width, double height) {
  cairo_rectangle(impl_->get(), x, y, width, height);
  cairo_stroke(impl_->get());
}

void PdfPage::Line(double x0, double y0, double x1, double y1) {
  cairo_move_to(impl_->get(), x0, y0);
  cairo_line_to(impl_->get(), x1, y1);
  cairo_stroke(impl_->get());
}

void PdfPage::Dot(double x, double y, double radius) {
  cairo_new_path(impl_->get());
  cairo_arc(impl_->get(), x, y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(impl_->get());
}

void PdfPage::Shape(const std::vector<Eigen::Vector2d>& points, bool filled) {
  cairo_new_path(impl_->get());  // a text leaves a point behind
  for (const Eigen::Vector2d& p : points) cairo_line_to(impl_->get(), p.x(), p.y());
  cairo_close_path(impl_->get());
  filled ? cairo_fill(impl_->get()) : cairo_stroke(impl_->get());
}

void PdfPage::Polyline(const std::vector<Eigen::Vector2d>& points) {
  cairo_new_path(impl_->get());
  for (const Eigen::Vector2d& p : points) cairo_line_to(impl_->get(), p.x(), p.y());
  cairo_stroke(impl_->get());
}

void PdfPage::Picture(double x, double y, double width, double height, const ColorImage& image) {
  if (image.empty()) return;
  const std::unique_ptr<cairo_surface_t, Closer> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width(), image.height()));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return;
  unsigned char* const bytes = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  for (int v = 0; v < image.height(); ++v) {
    auto* const row =
        reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::size_t>(v) * stride);
    for (int u = 0; u < image.width(); ++u) {
      const Rgb8 pixel = image(u, v);
      row[u] = (std::uint32_t{pixel.r} << 16) | (std::uint32_t{pixel.g} << 8) | pixel.b;
    }
  }
  cairo_surface_mark_dirty(surface.get());
  KeepAsJpeg(surface.get(), image);
  cairo_save(impl_->get());
  cairo_translate(impl_->get(), x, y);
  cairo_scale(impl_->get(), width / image.width(), height / image.height());
  cairo_set_source_surface(impl_->get(), surface.get(), 0.0, 0.0);
  cairo_rectangle(impl_->get(), 0.0, 0.0, image.width(), image.height());
  cairo_fill(impl_->get());
  cairo_restore(impl_->get());
}

void PdfPage::NextPage() {
  cairo_show_page(impl_->get());
}

void PdfPage::Text(double x, double y, double size_mm, const std::string& text) {
  cairo_set_font_size(impl_->get(), size_mm);
  cairo_move_to(impl_->get(), x, y);
  cairo_show_text(impl_->get(), text.c_str());
}

void PdfPage::BoldText(double x, double y, double size_mm, const std::string& text) {
  SelectFont(impl_->get(), CAIRO_FONT_WEIGHT_BOLD);
  Text(x, y, size_mm, text);
  SelectFont(impl_->get(), CAIRO_FONT_WEIGHT_NORMAL);
}

void PdfPage::Upwards(double x, double y, double size_mm, const std::string& text) {
  cairo_save(impl_->get());
  cairo_translate(impl_->get(), x, y);
  cairo_rotate(impl_->get(), -0.5 * std::numbers::pi);
  Text(0.0, 0.0, size_mm, text);
  cairo_restore(impl_->get());
}

double PdfPage::TextWidth(double size_mm, const std::string& text) {
  cairo_set_font_size(impl_->get(), size_mm);
  cairo_text_extents_t extents;
  cairo_text_extents(impl_->get(), text.c_str(), &extents);
  return extents.x_advance;
}

Result<std::string> PdfPage::Bytes() && {
  cairo_show_page(impl_->get());
  const cairo_status_t status = cairo_status(impl_->get());
  impl_->context.reset();
  cairo_surface_finish(impl_->surface.get());
  const cairo_status_t end = cairo_surface_status(impl_->surface.get());
  if (status != CAIRO_STATUS_SUCCESS || end != CAIRO_STATUS_SUCCESS)
    return Fail(ErrorCode::kIo, "PDF: {}",
                cairo_status_to_string(status != CAIRO_STATUS_SUCCESS ? status : end));
  return std::move(impl_->bytes);
}

}  // namespace foresight
