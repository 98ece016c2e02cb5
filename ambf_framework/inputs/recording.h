// Reads a recording of inputs. Its first damaged record ends it; nothing in it is trusted. Not thread-safe.
#pragma once

#include <cstdint>
#include <deque>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "inputs/bytes.h"
#include "inputs/recorder.h"
#include "inputs/records.h"

namespace ambf::inputs {

struct RawRecord {
  Type type{};
  Bytes bytes;

  // None: the bytes are no such record.
  template <class Record>
  std::optional<Record> as() const {
    Record record;
    Reader reader(bytes.data(), bytes.size());
    Record::members(record, reader);
    if (type != Record::kType || !reader.good() || !reader.at_end()) return std::nullopt;
    return record;
  }
};

class Recording {
 public:
  // Null, with `problem` in one line: it cannot be read, is no such file, or is of another version.
  static std::unique_ptr<Recording> open(const std::string& path, std::string& problem);
  static std::unique_ptr<Recording> read(std::unique_ptr<std::istream> bytes, std::string& problem);

  const SessionRecord& session() const { return session_; }

  // The next record of a stream, null at its end. Valid until the next call for this stream.
  const RawRecord* next(Stream stream);
  // The same without moving on.
  const RawRecord* peek(Stream stream);
  // The next record of any stream, in the order of the file; not to be mixed with the other two.
  bool next_of_any(RawRecord& record, Stream& stream);

  // Known once next() has found the end of a stream.
  bool ended_properly() const { return ended_; }
  std::optional<Stream> gap() const { return gap_; }
  // Bytes at the end of the file that are no whole record: what was being written when the simulation was killed.
  std::uint64_t ignored_bytes() const { return ignored_; }
  // A whole record had another checksum: no recorder that was killed leaves that.
  bool damaged() const { return damaged_; }

 private:
  explicit Recording(std::unique_ptr<std::istream> bytes) : input_(std::move(bytes)) {}
  bool read_record(RawRecord& record, Stream& stream);
  bool fill(Stream stream);

  std::unique_ptr<std::istream> input_;
  std::uint64_t left_ = 0;  // bytes of the file
  SessionRecord session_;
  std::map<Stream, std::deque<RawRecord>> waiting_;
  std::map<Stream, RawRecord> given_;
  bool at_end_ = false, ended_ = false, damaged_ = false;
  std::optional<Stream> gap_;
  std::uint64_t ignored_ = 0;
};

}  // namespace ambf::inputs
