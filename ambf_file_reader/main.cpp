// ambf_file_reader: reads one file with parsers of others (assimp, urdfdom), answers over its standard streams and
// ends. base/worker.h has the protocol; only libambf_core starts it.
#include <cstdlib>
#include <exception>

#include "channel.h"
#include "limits.h"
#include "mesh_reader.h"
#include "urdf_reader.h"

namespace {

using namespace ambf;

template <typename Answer, typename Read>
Answer read_or_report(const Read& read) {
  try {
    return read();
  } catch (const std::exception& error) {
    Answer answer;
    answer.error = error.what();
    return answer;
  }
}

std::string mesh_answer(base::WireReader& reader) {
  mesh::ReaderQuestion question;
  mesh::transfer_question(reader, question);
  if (!reader.at_end()) return {};
  auto answer = read_or_report<mesh::ReaderAnswer>([&] { return file_reader::read_mesh(question); });
  base::WireWriter writer;
  mesh::transfer_answer(writer, answer);
  return std::move(writer).bytes();
}

std::string urdf_answer(base::WireReader& reader) {
  std::string text;
  reader.text(text);
  if (!reader.at_end()) return {};
  auto answer = read_or_report<adf::urdf::Robot>([&] { return file_reader::read_urdf(text); });
  base::WireWriter writer;
  adf::urdf::transfer(writer, answer);
  return std::move(writer).bytes();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  file_reader::limit_this_process(std::atoi(argv[1]));
  const std::string bytes = file_reader::receive_question();
  base::WireReader reader(bytes);
  std::string task;
  reader.text(task);
  const std::string answer = task == "mesh" ? mesh_answer(reader) : task == "urdf" ? urdf_answer(reader) : "";
  if (answer.empty()) return 1;
  file_reader::send_answer(answer);
  std::_Exit(0);  // assimp's destructors would run for nothing
}
