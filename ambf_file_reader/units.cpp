#include "units.h"

#include <assimp/scene.h>
#include <zlib.h>

#include <algorithm>

namespace ambf::file_reader {

namespace {

// assimp ignores the unit of 3MF and AMF: it is an attribute of the first element.
std::string unit_attribute(const std::string& xml, const std::string& element) {
  const std::size_t start = xml.find("<" + element);
  if (start == std::string::npos) return {};
  const std::string tag = xml.substr(start, xml.find('>', start) - start);
  const std::size_t at = tag.find("unit");
  const std::size_t open = at == std::string::npos ? at : tag.find_first_of("\"'", at);
  if (open == std::string::npos) return {};
  return tag.substr(open + 1, tag.find(tag[open], open + 1) - open - 1);
}

double metres_of(const std::string& unit, double otherwise) {
  if (unit == "micron") return 1e-6;
  if (unit == "millimeter") return 1e-3;
  if (unit == "centimeter") return 1e-2;
  if (unit == "meter") return 1.0;
  if (unit == "inch") return 0.0254;
  if (unit == "foot" || unit == "feet") return 0.3048;
  return otherwise;
}

std::uint32_t number_at(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = size; i-- > 0;) {
    value = value << 8 | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0U);
  }
  return value;
}

// The first 64 KiB of a member of a zip archive; `entry`: its place in the central directory.
std::string start_of_member(const std::string& zip, std::size_t entry) {
  const std::size_t header = number_at(zip, entry + 42, 4);
  const std::size_t data = header + 30 + number_at(zip, header + 26, 2) + number_at(zip, header + 28, 2);
  if (data >= zip.size()) return {};
  const std::size_t packed = std::min<std::size_t>(number_at(zip, entry + 20, 4), zip.size() - data);
  constexpr std::size_t kMost = 65536;
  if (number_at(zip, entry + 10, 2) == 0) return zip.substr(data, std::min(packed, kMost));
  std::string text(kMost, '\0');
  z_stream stream{};
  if (::inflateInit2(&stream, -MAX_WBITS) != Z_OK) return {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(zip.data() + data));
  stream.avail_in = static_cast<uInt>(packed);
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  ::inflate(&stream, Z_SYNC_FLUSH);
  text.resize(stream.total_out);
  ::inflateEnd(&stream);
  return text;
}

// A 3MF file is a zip archive whose model is the member that ends in .model.
std::string model_of_3mf(const std::string& zip) {
  const std::size_t end = zip.rfind("PK\5\6");
  if (end == std::string::npos) return {};
  std::size_t entry = number_at(zip, end + 16, 4);
  for (std::uint32_t left = number_at(zip, end + 10, 2);
       left > 0 && entry < zip.size() && zip.compare(entry, 4, "PK\1\2") == 0; --left) {
    const std::size_t name = number_at(zip, entry + 28, 2);
    const std::string path = zip.substr(std::min(entry + 46, zip.size()), name);
    if (path.size() > 6 && path.compare(path.size() - 6, 6, ".model") == 0) return start_of_member(zip, entry);
    entry = std::min(zip.size(), entry + 46 + name + number_at(zip, entry + 30, 2) + number_at(zip, entry + 32, 2));
  }
  return {};
}

}  // namespace

Units units_of(const mesh::ReaderQuestion& question, const aiScene& scene) {
  Units units;
  const std::string& kind = question.ending;
  constexpr double kMillimetre = 1e-3;  // the default of both formats
  if (kind == "3mf") units.metres = metres_of(unit_attribute(model_of_3mf(question.bytes), "model"), kMillimetre);
  if (kind == "amf") units.metres = metres_of(unit_attribute(question.bytes.substr(0, 65536), "amf"), kMillimetre);
  if (kind == "fbx" && scene.mMetaData != nullptr) {
    double centimetres = 1.0;  // one unit of the file
    float single = 1.0F;
    if (scene.mMetaData->Get("UnitScaleFactor", single)) centimetres = single;
    scene.mMetaData->Get("UnitScaleFactor", centimetres);
    if (centimetres > 0.0) units.metres = 0.01 * centimetres;
    std::int32_t up = 2;
    if (scene.mMetaData->Get("UpAxis", up) && up == 1) units.note = "the file says that y is up; axes are left alone";
  }
  if (kind == "glb" || kind == "gltf") units.note = "glTF files have y up; axes are left alone";
  return units;
}

}  // namespace ambf::file_reader
