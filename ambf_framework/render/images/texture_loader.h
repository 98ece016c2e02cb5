// Decodes texture files on a thread of its own, mip levels included, so that a large picture freezes no window. Asked
// and emptied by the thread that draws; no OpenGL here. Private to render/.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "render/images/image_file.h"

namespace ambf::render {

// A normal map's numbers are directions, not colours: they are averaged as they are, and a grey picture is taken for
// heights. Raw ones are for users' shaders, which know no linear light.
enum class TextureUse { color, normal, sky, raw };

struct TextureKey {
  std::string file;
  TextureUse use = TextureUse::color;
  bool operator<(const TextureKey& o) const { return std::tie(file, use) < std::tie(o.file, o.use); }
};

struct Decoded {
  TextureKey key;
  std::vector<Image> levels;  // the first is the largest; rows from bottom to top (sky: from top to bottom)
  bool has_alpha = false;     // some of it is not opaque
  std::string why;            // when it could not be read: levels is empty
};

class TextureLoader {
 public:
  // Pictures larger than `largest_side` are halved until they are not.
  explicit TextureLoader(int largest_side) : largest_side_(largest_side) {}
  ~TextureLoader();
  TextureLoader(const TextureLoader&) = delete;
  TextureLoader& operator=(const TextureLoader&) = delete;

  // `bytes`: of a picture that is no file of its own; null: the file that the key names is read.
  void ask(TextureKey key, std::shared_ptr<const std::string> bytes = nullptr);
  std::vector<Decoded> take_finished();
  bool busy() const;
  void wait();  // until all that was asked for is finished

 private:
  struct Asked {
    TextureKey key;
    std::shared_ptr<const std::string> bytes;
  };
  void work();

  const int largest_side_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Asked> asked_;
  std::vector<Decoded> finished_;
  bool working_ = false, ending_ = false;
  std::thread thread_;  // started when first needed
};

// OpenGL's first row is the lowest one, but for cubes; files begin at the top.
void flip_rows(Image& image);

// What the thread does for each: public for its tests.
Decoded decode(const TextureKey& key, int largest_side, const std::string* bytes = nullptr);

}  // namespace ambf::render
