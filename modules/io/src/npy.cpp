// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// NumPy's "NEP 1 - A simple file format for NumPy arrays". The header is a dict of Python, of which only the
// three keys that NumPy writes are read.

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "fields.h"
#include "npy_format.h"
#include "pcl_bv/io/numpy.h"
#include "text.h"

namespace pcl_bv::detail {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

[[noreturn]] void invalid_npy(const std::string& what) {
  throw IoError("header: " + what);
}

// A cursor over the dict.
class PythonText {
 public:
  explicit PythonText(std::string_view text) : text_(text) {}

  bool take(char c) {
    const bool found = peek() == c;
    at_ += found;
    return found;
  }

  void expect(char c) {
    if (!take(c)) invalid_npy(std::string("no '") + c + "' where the array's description needs it");
  }

  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n'))
      ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  std::string_view string() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') invalid_npy("a text is missing in the array's description");
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) invalid_npy("a text has no end");
    const std::string_view found = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return found;
  }

  std::string_view word() {
    peek();
    const std::size_t end = std::min(text_.find_first_of(" ,)}]\n", at_), text_.size());
    const std::string_view found = text_.substr(at_, end - at_);
    at_ = end;
    return found;
  }

  bool boolean(std::string_view key) {
    const std::string_view value = word();
    if (value != "True" && value != "False")
      invalid_npy(in_quotes(key) + " is " + in_quotes(value) + ", not True or False");
    return value == "True";
  }

  // A tuple such as (3,) or ().
  std::vector<std::size_t> sizes() {
    std::vector<std::size_t> found;
    expect('(');
    while (!take(')')) {
      std::size_t value = 0;
      std::string_view number = word();
      if (number.ends_with('L')) number.remove_suffix(1);  // Python 2's long numbers
      if (!read_number(number, value)) invalid_npy(in_quotes(number) + " is no size");
      found.push_back(value);
      if (found.size() > 8) invalid_npy("more than 8 dimensions");
      if (!take(',') && peek() != ')') invalid_npy("a shape has no end");
    }
    return found;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

// Returns the type letter and size of a description such as "<f4".
PointField npy_field(std::string_view descr, std::string name) {
  if (descr.size() == 3 && descr[0] == '>' && descr[2] != '1')
    invalid_npy("values are big-endian: save array.astype(array.dtype.newbyteorder('<'))");
  const char type = descr.size() == 3 ? descr[1] : '?';
  const char size = descr.size() == 3 ? descr[2] : '?';
  const bool floating = type == 'f' && (size == '4' || size == '8');
  const bool integer =
      (type == 'i' || type == 'u') && (size == '1' || size == '2' || size == '4' || size == '8');
  if (!floating && !integer)
    invalid_npy("values of type " + in_quotes(descr) + " are not float32, float64 or integers");
  const char letter = type == 'f' ? 'F' : type == 'i' ? 'I' : 'U';
  return {std::move(name), letter, static_cast<std::uint32_t>(size - '0'), 1, 0};
}

void add_field(PointField field, RawCloud& cloud) {
  if (cloud.fields.size() == kMaxColumns) invalid_npy("more than 4096 columns");
  append_field(std::move(field), cloud);
}

// Reads [('x', '<f4'), ('rgb', 'u1', (3,)), ...].
void read_record_type(PythonText& text, RawCloud& cloud) {
  text.expect('[');
  while (!text.take(']')) {
    text.expect('(');
    if (text.peek() == '(') invalid_npy("fields with titles are not supported");
    std::string name(text.string());
    text.expect(',');
    if (text.peek() == '[') invalid_npy("field " + in_quotes(name) + " is a record");
    // NumPy names the gaps of aligned records '' and gives them the type of bytes.
    const std::string_view descr = text.string();
    const bool gap = name.empty() && descr.starts_with("|V");
    PointField field = npy_field(gap ? "|u1" : descr, gap ? "_" : name);
    if (gap && !read_number(descr.substr(2), field.count)) invalid_npy("a gap has no size");
    if (!gap && !is_word(name)) invalid_npy("the field name " + in_quotes(name) + " is no word");
    if (text.take(',') && text.peek() == '(') {
      for (const std::size_t size : text.sizes()) {
        if (size == 0 || size > kMaxColumns)
          invalid_npy("field " + in_quotes(name) + " has no or too many elements");
        field.count *= static_cast<std::uint32_t>(size);
        if (field.count > 1'000'000) invalid_npy("field " + in_quotes(name) + " has too many elements");
      }
    }
    if (field.count == 0 || field.count > 1'000'000) invalid_npy("a field has no or too many elements");
    text.expect(')');
    add_field(std::move(field), cloud);
    text.take(',');
  }
}

constexpr std::size_t kManyColumns = 16;  // more of them, for few points, suggest a transposed array

// Makes fields of the columns of numbers.
void add_columns(const PointField& number, std::size_t columns, RawCloud& cloud) {
  if (columns < 3) invalid_npy("the array has " + std::to_string(columns) + " columns, not 3 or more");
  if (columns > kMaxColumns) invalid_npy("more than 4096 columns");
  for (std::size_t i = 0; i < columns; ++i) {
    PointField field = number;
    field.name = default_column_name(i, columns);
    add_field(std::move(field), cloud);
  }
}

void set_size(const std::vector<std::size_t>& shape, RawCloud& cloud) {
  if (shape.empty() || shape.size() > 2)
    invalid_npy("the array is no list of points: it has another number of dimensions");
  cloud.height = shape.size() == 2 ? shape[0] : 1;
  cloud.width = shape.back();
  constexpr std::size_t most = std::size_t{1} << 48;  // bytes of a file
  if (cloud.width > most || cloud.height > most ||
      (cloud.height > 0 && cloud.width > most / cloud.height / cloud.point_step))
    invalid_npy("the shape has more points than a file can hold");
}

}  // namespace

NpyHeader parse_npy_header(std::string_view start) {
  if (!start.starts_with(kMagic) || start.size() < 12) throw IoError("is no .npy array");
  const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(start[i])}; };
  const std::size_t major = byte(6);
  if (major < 1 || major > 3) invalid_npy("version " + std::to_string(major) + " is not 1, 2 or 3");
  const std::size_t begin = major == 1 ? 10 : 12;
  const std::size_t length = byte(8) | byte(9) << 8 | (major == 1 ? 0 : byte(10) << 16 | byte(11) << 24);
  if (length > start.size() - begin) throw IoError("truncated: the header is cut or too long");
  PythonText text(start.substr(begin, length));
  NpyHeader header;
  RawCloud& cloud = header.records.cloud;
  std::optional<PointField> number;
  std::optional<std::vector<std::size_t>> shape;
  text.expect('{');
  while (!text.take('}')) {
    const std::string_view key = text.string();
    text.expect(':');
    if (key == "descr") {
      if (text.peek() == '[') {
        read_record_type(text, cloud);
      } else {
        number = npy_field(text.string(), "");
      }
    } else if (key == "shape") {
      shape = text.sizes();
    } else if (key == "fortran_order") {
      header.by_column = text.boolean(key);
    } else {
      invalid_npy("unknown key " + in_quotes(key));
    }
    text.take(',');
  }
  if (!shape || (!number && cloud.fields.empty())) invalid_npy("no \"descr\" or no \"shape\"");
  if (number) {
    if (shape->size() < 2) invalid_npy("the array has one column, not 3 or more");
    if (header.by_column && shape->size() > 2)
      invalid_npy("organised clouds in Fortran's order are not supported");
    add_columns(*number, shape->back(), cloud);
    if (shape->size() == 2 && shape->front() >= 3 && shape->front() <= 8 && shape->back() > kManyColumns)
      add_note(cloud, std::to_string(shape->front()) + " points with " + std::to_string(shape->back()) +
                          " columns: if the array has a column for each point, store its transpose");
    shape->pop_back();
  }
  header.by_column = header.by_column && number.has_value();
  set_size(*shape, cloud);
  require_coordinates(cloud);
  header.records.encoding = PcdEncoding::binary;
  header.records.data_offset = begin + length;
  return header;
}

NpyHeader read_npy_header(const InputFile& file) {
  std::string start(std::min(file.size(), kMaxHeaderBytes), '\0');
  file.read(0, start.data(), std::min<std::size_t>(start.size(), 12));
  const bool short_header = start.size() >= 12 && start[6] == 1;
  start.resize(std::min<std::size_t>(start.size(), short_header ? 65546 : kMaxHeaderBytes));
  file.read(0, start.data(), start.size());
  NpyHeader header = parse_npy_header(start);
  if (!header.by_column) require_records(file, header.records);
  return header;
}

namespace {

// Copies columns to records.
template <typename ReadColumn>
void read_columns(RawCloud& cloud, const ReadColumn& read) {
  ByteBuffer column;
  std::size_t at = 0;
  for (const PointField& field : cloud.fields) {
    column.resize(field.size * cloud.size());
    read(at, column.data(), column.size());
    at += column.size();
    copy_strided({column.data(), 0, field.size}, {cloud.data.data(), field.offset, cloud.point_step},
                 field.size, cloud.size());
  }
}

template <typename Read>
void read_npy_array(std::size_t available, NpyHeader& header, const Read& read) {
  RawCloud& cloud = header.records.cloud;
  const std::size_t bytes = cloud.size() * cloud.point_step;
  if (bytes > available)
    throw IoError("truncated: " + std::to_string(cloud.size()) + " points need " + std::to_string(bytes) +
                  " bytes, there are " + std::to_string(available));
  cloud.data.resize(bytes);
  const std::size_t begin = header.records.data_offset;
  if (header.by_column) {
    read_columns(cloud, [&](std::size_t at, std::byte* to, std::size_t size) { read(begin + at, to, size); });
  } else if (bytes > 0) {
    read(begin, cloud.data.data(), bytes);
  }
}

}  // namespace

void read_npy_points(const InputFile& file, NpyHeader& header) {
  read_npy_array(file.size() - header.records.data_offset, header,
                 [&](std::size_t at, std::byte* to, std::size_t size) { file.read(at, to, size); });
}

void read_npy_points(std::string_view bytes, NpyHeader& header) {
  read_npy_array(bytes.size() - header.records.data_offset, header,
                 [&](std::size_t at, std::byte* to, std::size_t size) {
                   if (size > 0) std::memcpy(to, bytes.data() + at, size);
                 });
}

}  // namespace pcl_bv::detail
