#include "render/drawing/text/fonts.h"

#include <fmt/format.h>
#include <fontconfig/fontconfig.h>
#include <hb-subset.h>
#include <pango/pangocairo.h>

#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "render/drawing/text/pango_text.h"

namespace lekalo::render {

namespace {

constexpr double kMeasured = 1000;  // size at which extents are taken

// Families by what they are for, and their packages.
constexpr const char* kSerif = "CMU Serif";
constexpr const char* kFormulaGreek = "CMU Classical Serif";  // Greek as TeX has it in formulas: in italics only
constexpr const char* kTheta = "CMU Bright";  // the only one with a theta in italics; the others have a vartheta
constexpr const char* kSans = "CMU Sans Serif";
constexpr const char* kMono = "CMU Typewriter Text";
constexpr const char* kSigns[] = {"DejaVu Serif", "DejaVu Sans"};
constexpr const char* kAlphabets = "DejaVu Math TeX Gyre";  // the only one with whole script and Fraktur alphabets

struct FontFile {
  std::string path;
  int index = 0;
  FcCharSet* characters = nullptr;  // kept as long as the program
};

struct Unref {
  void operator()(FcPattern* pattern) const { FcPatternDestroy(pattern); }
};
using Pattern = std::unique_ptr<FcPattern, Unref>;

std::mutex mutex_of_fonts;

// The file of a font; fontconfig may offer another family for one that is not there.
const FontFile& file_of(const Font& font) {
  static std::map<Font, FontFile> files;
  if (const auto found = files.find(font); found != files.end()) return found->second;
  const Pattern wanted(FcPatternCreate());
  FcPatternAddString(wanted.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>(font.family.c_str()));
  FcPatternAddInteger(wanted.get(), FC_WEIGHT, font.bold ? FC_WEIGHT_BOLD : FC_WEIGHT_MEDIUM);
  FcPatternAddInteger(wanted.get(), FC_SLANT, font.italic ? FC_SLANT_ITALIC : FC_SLANT_ROMAN);
  FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult result;
  const Pattern match(FcFontMatch(nullptr, wanted.get(), &result));
  FcChar8 *family = nullptr, *path = nullptr;
  FontFile file;
  FcCharSet* characters = nullptr;
  if (!match || FcPatternGetString(match.get(), FC_FAMILY, 0, &family) != FcResultMatch ||
      font.family != reinterpret_cast<const char*>(family) ||
      FcPatternGetString(match.get(), FC_FILE, 0, &path) != FcResultMatch ||
      FcPatternGetCharSet(match.get(), FC_CHARSET, 0, &characters) != FcResultMatch)
    throw std::runtime_error(fmt::format("the font '{}' is not installed: texts of drawings need it (Debian: {})",
                                         font.family,
                                         font.family.starts_with("CMU") ? "fonts-cmu"
                                         : font.family == kAlphabets    ? "fonts-dejavu-extra"
                                                                        : "fonts-dejavu-core"));
  file.path = reinterpret_cast<const char*>(path);
  FcPatternGetInteger(match.get(), FC_INDEX, 0, &file.index);
  file.characters = FcCharSetCopy(characters);
  return files.emplace(font, file).first->second;
}

// CMU Serif's italics are those of Greek texts: its rho is a varrho, its kappa a varkappa.
bool is_formula_greek(const Font& font, char32_t character) {
  return font.family == kSerif && font.italic && !font.bold && character >= U'α' && character <= U'ω' &&
         character != U'ε';  // which is a lunate one there
}

// A letter of one of these alphabets.
bool is_script_or_fraktur(char32_t character) {
  return (character >= 0x1D49C && character <= 0x1D537) ||
         std::u32string_view(U"ℬℰℱℋℐℒℳℛℭℌℨ").find(character) != std::u32string_view::npos;
}

// The next character of UTF-8 text, which is known to be well formed.
char32_t next(std::string_view text, size_t& i) {
  FcChar32 character = 0;
  const int length =
      FcUtf8ToUcs4(reinterpret_cast<const FcChar8*>(text.data() + i), &character, static_cast<int>(text.size() - i));
  if (length <= 0) throw std::runtime_error("a text is not UTF-8");
  i += static_cast<size_t>(length);
  return character;
}

}  // namespace

std::string font_family(std::string_view kind) { return kind == "sans" ? kSans : kind == "mono" ? kMono : kSerif; }

std::vector<FontRun> font_runs(const Font& font, std::string_view text) {
  const std::scoped_lock lock(mutex_of_fonts);
  std::vector<FontRun> runs;
  for (size_t i = 0; i < text.size();) {
    const size_t begin = i;
    const char32_t character = next(text, i);
    std::vector<Font> choices;
    if (is_formula_greek(font, character)) choices.push_back({character == U'θ' ? kTheta : kFormulaGreek, true, false});
    if (is_script_or_fraktur(character)) choices.push_back({kAlphabets, false, false});
    choices.push_back(font);
    for (const char* signs : kSigns) choices.push_back({signs, false, font.bold});
    const Font* chosen = nullptr;
    for (const Font& one : choices)
      if (!chosen && FcCharSetHasChar(file_of(one).characters, character)) chosen = &one;
    if (!chosen)
      throw std::runtime_error(fmt::format("no font of drawings has the character '{}' (U+{:04X})",
                                           text.substr(begin, i - begin), static_cast<uint32_t>(character)));
    if (runs.empty() || runs.back().font != *chosen) runs.push_back({*chosen, ""});
    runs.back().text += text.substr(begin, i - begin);
  }
  return runs;
}

TextExtent text_extent(const Font& font, const std::string& text) {
  static std::map<std::pair<Font, std::string>, TextExtent> known;
  const std::scoped_lock lock(mutex_of_fonts);
  const auto found = known.find({font, text});
  if (found != known.end()) return found->second;
  static const PangoContextPtr context = exact_context();
  const PangoLayoutPtr layout = layout_of(context.get(), font, text, kMeasured);
  PangoRectangle ink, logical;
  pango_layout_line_get_extents(pango_layout_get_line_readonly(layout.get(), 0), &ink, &logical);
  const double em = kMeasured * PANGO_SCALE;
  TextExtent extent;
  extent.advance = logical.width / em;
  extent.left = ink.x / em, extent.right = (ink.x + ink.width) / em;
  extent.above = -ink.y / em, extent.below = -(ink.y + ink.height) / em;
  return known.emplace(std::pair(font, text), extent).first->second;
}

std::string font_subset(const Font& font, std::string_view characters) {
  const std::scoped_lock lock(mutex_of_fonts);
  const FontFile& file = file_of(font);
  hb_blob_t* const blob = hb_blob_create_from_file(file.path.c_str());
  hb_face_t* const face = hb_face_create(blob, static_cast<unsigned>(file.index));
  hb_subset_input_t* const input = hb_subset_input_create_or_fail();
  for (size_t i = 0; i < characters.size();) hb_set_add(hb_subset_input_unicode_set(input), next(characters, i));
  hb_face_t* const part = hb_subset_or_fail(face, input);
  std::string result;
  if (part) {
    hb_blob_t* const bytes = hb_face_reference_blob(part);
    unsigned length = 0;
    const char* const data = hb_blob_get_data(bytes, &length);
    result.assign(data, length);
    hb_blob_destroy(bytes);
    hb_face_destroy(part);
  }
  hb_subset_input_destroy(input);
  hb_face_destroy(face);
  hb_blob_destroy(blob);
  if (result.empty()) throw std::runtime_error(fmt::format("the font file {} cannot be read", file.path));
  return result;
}

}  // namespace lekalo::render
