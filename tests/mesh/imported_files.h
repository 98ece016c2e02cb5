// One asymmetric object, a wedge of four triangles 30 x 20 x 10 mm large, in each format that assimp reads for us: each
// with the unit, the placement and the kind of colour that the format has.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/mesh/files.h"

namespace ambf::mesh::test {

// Corners of its triangles in metres, counter-clockwise seen from outside.
inline std::vector<math::Vec3> wedge() {
  const math::Vec3 o{0, 0, 0}, x{0.03, 0, 0}, y{0, 0.02, 0}, z{0, 0, 0.01};
  return {o, y, x, o, x, z, o, z, y, x, y, z};
}

// Red, green / blue, white as PNG, in base 64.
inline constexpr const char* kPicture64 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR42mP4z8DAAMIM/4EAAB/uBfvxq7p3AAAAAElFTkSuQmCC";

inline std::string from_base64(const std::string& text) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(kDigits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

// An archive of files that are stored as they are.
inline std::string zip(const std::vector<std::pair<std::string, std::string>>& files) {
  const auto crc = [](const std::string& bytes) {
    std::uint32_t value = ~0U;
    for (const char c : bytes) {
      value ^= static_cast<unsigned char>(c);
      for (int k = 0; k < 8; ++k) value = value >> 1 ^ (value & 1U ? 0xEDB88320U : 0U);
    }
    return ~value;
  };
  std::string archive, directory;
  for (const auto& [name, bytes] : files) {
    std::string common;  // of both headers, from the version needed to the length of the extra field
    for (const std::uint16_t half : std::initializer_list<std::uint16_t>{20, 0, 0, 0, 33}) put(common, half);
    put(common, crc(bytes));
    put(common, static_cast<std::uint32_t>(bytes.size()));
    put(common, static_cast<std::uint32_t>(bytes.size()));
    put(common, static_cast<std::uint16_t>(name.size()));
    put<std::uint16_t>(common, 0);
    directory += std::string("PK\1\2\24\0", 6) + common + std::string(10, '\0');
    put(directory, static_cast<std::uint32_t>(archive.size()));
    directory += name;
    archive += "PK\3\4" + common + name + bytes;
  }
  std::string end("PK\5\6\0\0\0\0", 8);
  put(end, static_cast<std::uint16_t>(files.size()));
  put(end, static_cast<std::uint16_t>(files.size()));
  put(end, static_cast<std::uint32_t>(directory.size()));
  put(end, static_cast<std::uint32_t>(archive.size()));
  return archive + directory + end + std::string(2, '\0');
}

inline std::string off_wedge() {
  return "OFF\n4 4 0\n0 0 0\n0.03 0 0\n0 0.02 0\n0 0 0.01\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

inline std::string amf_wedge() {
  const auto vertex = [](const std::string& x, const std::string& y, const std::string& z) {
    return "<vertex><coordinates><x>" + x + "</x><y>" + y + "</y><z>" + z + "</z></coordinates></vertex>";
  };
  const auto triangle = [](const std::string& a, const std::string& b, const std::string& c) {
    return "<triangle><v1>" + a + "</v1><v2>" + b + "</v2><v3>" + c + "</v3></triangle>";
  };
  return "<?xml version=\"1.0\"?>\n<amf unit=\"millimeter\"><material "
         "id=\"1\"><color><r>0.2</r><g>0.4</g><b>0.6</b></color>"
         "</material><object id=\"0\"><mesh><vertices>" +
         vertex("0", "0", "0") + vertex("30", "0", "0") + vertex("0", "20", "0") + vertex("0", "0", "10") +
         "</vertices><volume materialid=\"1\">" + triangle("0", "2", "1") + triangle("0", "1", "3") +
         triangle("0", "3", "2") + triangle("1", "2", "3") + "</volume></mesh></object></amf>\n";
}

inline std::string x3d_wedge() {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<X3D profile="Interchange" version="3.0"><Scene>
  <Transform translation="0.01 0 0"><Transform translation="-0.01 0 0" scale="0.01 0.01 0.01"><Shape>
    <Appearance><Material diffuseColor="0.2 0.4 0.6"/><ImageTexture url='"wood.png"'/></Appearance>
    <IndexedFaceSet coordIndex="0 2 1 -1 0 1 3 -1 0 3 2 -1 1 2 3 -1">
      <Coordinate point="0 0 0 3 0 0 0 2 0 0 0 1"/></IndexedFaceSet>
  </Shape></Transform></Transform>
</Scene></X3D>
)";
}

inline std::string threemf_wedge() {
  const std::string types =
      "<?xml version=\"1.0\"?><Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"><Default "
      "Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default "
      "Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>";
  const std::string relations =
      "<?xml version=\"1.0\"?><Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
      "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  const std::string model =
      "<?xml version=\"1.0\"?><model unit=\"centimeter\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources><basematerials id=\"5\"><base "
      "name=\"blue\" displaycolor=\"#336699\"/></basematerials><object id=\"1\" type=\"model\" pid=\"5\" "
      "pindex=\"0\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"3\" y=\"0\" z=\"0\"/><vertex x=\"0\" "
      "y=\"2\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/>"
      "<triangle v1=\"0\" v2=\"1\" v3=\"3\"/><triangle v1=\"0\" v2=\"3\" v3=\"2\"/><triangle v1=\"1\" v2=\"2\" "
      "v3=\"3\"/></triangles></mesh></object></resources><build><item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0 "
      "0\"/></build></model>";
  return zip({{"[Content_Types].xml", types}, {"_rels/.rels", relations}, {"3D/3dmodel.model", model}});
}

// In centimetres (the format's own unit when it says 1), turned inside out by a mirror in its node, with a picture
// within.
inline std::string fbx_wedge() {
  return std::string(R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UpAxis", "int", "Integer", "",2
		P: "UpAxisSign", "int", "Integer", "",1
		P: "FrontAxis", "int", "Integer", "",1
		P: "FrontAxisSign", "int", "Integer", "",-1
		P: "CoordAxis", "int", "Integer", "",0
		P: "CoordAxisSign", "int", "Integer", "",1
		P: "UnitScaleFactor", "double", "Number", "",1
	}
}
Definitions:  {
	Version: 100
	Count: 4
}
Objects:  {
	Geometry: 1, "Geometry::wedge", "Mesh" {
		Vertices: *12 {
			a: 0,0,0,-3,0,0,0,2,0,0,0,1
		}
		PolygonVertexIndex: *12 {
			a: 0,1,-3,0,3,-2,0,2,-4,1,3,-3
		}
		GeometryVersion: 124
		LayerElementUV: 0 {
			Version: 101
			Name: "UVMap"
			MappingInformationType: "ByVertice"
			ReferenceInformationType: "Direct"
			UV: *8 {
				a: 0,0,1,0,0,1,1,1
			}
		}
		LayerElementMaterial: 0 {
			Version: 101
			Name: ""
			MappingInformationType: "AllSame"
			ReferenceInformationType: "IndexToDirect"
			Materials: *1 {
				a: 0
			}
		}
		Layer: 0 {
			Version: 100
			LayerElement:  {
				Type: "LayerElementMaterial"
				TypedIndex: 0
			}
			LayerElement:  {
				Type: "LayerElementUV"
				TypedIndex: 0
			}
		}
	}
	Model: 2, "Model::wedge", "Mesh" {
		Version: 232
		Properties70:  {
			P: "Lcl Scaling", "Lcl Scaling", "", "A",-1,1,1
		}
	}
	Material: 3, "Material::painted", "" {
		Version: 102
		ShadingModel: "phong"
		Properties70:  {
			P: "DiffuseColor", "Color", "", "A",0.2,0.4,0.6
			P: "Opacity", "double", "Number", "",0.5
		}
	}
	Texture: 4, "Texture::picture", "" {
		Type: "TextureVideoClip"
		Version: 202
		TextureName: "Texture::picture"
		Media: "Video::picture"
		FileName: "C:\somewhere\picture.png"
		RelativeFilename: "picture.png"
	}
	Video: 5, "Video::picture", "Clip" {
		Type: "Clip"
		FileName: "C:\somewhere\picture.png"
		RelativeFilename: "picture.png"
		Content: , ")") +
         kPicture64 + R"("
	}
}
Connections:  {
	C: "OO",2,0
	C: "OO",1,2
	C: "OO",3,2
	C: "OP",4,3, "DiffuseColor"
	C: "OO",5,4
}
)";
}

// The wedge's buffer: positions of the mirrored wedge, texture coordinates, indices.
inline std::string gltf_buffer() {
  std::string bytes;
  for (const float f : {0.0F, 0.0F, 0.0F, -0.03F, 0.0F, 0.0F, 0.0F, 0.02F, 0.0F, 0.0F, 0.0F, 0.01F}) put(bytes, f);
  for (const float f : {0.0F, 1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 0.0F}) put(bytes, f);
  for (const int i : {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}) put(bytes, static_cast<std::uint16_t>(i));
  return bytes;
}

// `buffer` and `image`: the members that say where their bytes are.
inline std::string gltf_json(const std::string& buffer, const std::string& image, const std::string& more_views = "") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"children":[1],"scale":[-1,1,1]},{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],
"materials":[{"name":"brushed","alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,0.5],
"metallicFactor":0.75,"roughnessFactor":0.5,"baseColorTexture":{"index":0}},"normalTexture":{"index":1}}],
"textures":[{"source":0},{"source":1}],"images":[{)" +
         image + R"(},{"uri":"bumps.png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-0.03,0,0],"max":[0,0.02,0.01]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":2,"componentType":5123,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},
{"buffer":0,"byteOffset":80,"byteLength":24})" +
         more_views + R"(],"buffers":[{)" + buffer + "}]}";
}

inline std::string gltf_wedge() {
  return gltf_json(R"("uri":"wedge%20data.bin","byteLength":104)", R"("uri":"wood.png")");
}

inline std::string glb_wedge() {
  const std::string picture = from_base64(kPicture64);
  std::string binary = gltf_buffer() + picture;
  std::string json =
      gltf_json("\"byteLength\":" + std::to_string(binary.size()), R"("bufferView":3,"mimeType":"image/png")",
                R"(,{"buffer":0,"byteOffset":104,"byteLength":)" + std::to_string(picture.size()) + "}");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  for (const std::size_t n : {std::size_t{2}, 28 + json.size() + binary.size(), json.size()}) {
    put(bytes, static_cast<std::uint32_t>(n));
  }
  bytes += "JSON" + json;
  put(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

}  // namespace ambf::mesh::test
