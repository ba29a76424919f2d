#pragma once
// The arrays of a VTU file as lib/antilock/io/write_vtu.cpp writes them.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace antilock::test {

/// The bytes that a text in base64 stands for.
inline std::string from_base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  EXPECT_EQ(text.size() % 4, 0U);
  std::string bytes;
  for (std::size_t i = 0; i + 3 < text.size(); i += 4) {
    std::uint32_t group = 0;
    std::size_t fill = 0;
    for (std::size_t k = i; k < i + 4; ++k) {
      const std::size_t value = text[k] == '=' ? 0 : letters.find(text[k]);
      EXPECT_NE(value, std::string::npos);
      group = group << 6 | static_cast<std::uint32_t>(value);
      fill += text[k] == '=';
    }
    for (std::size_t k = 0; k < 3 - fill; ++k)
      bytes += static_cast<char>(group >> (16 - 8 * k) & 255);
  }
  return bytes;
}

/// Data of the VTU array of this name: its length in bytes and its numbers, in base64.
inline std::vector<double> vtu_array(const std::string& text, const std::string& name) {
  const std::size_t at = text.find(" Name=\"" + name + "\""), tag = text.rfind('<', at);
  const std::size_t from = text.find('>', at) + 1;
  const std::string bytes = from_base64(text.substr(from, text.find('<', from) - from));
  std::uint64_t length = 0;
  if (bytes.size() >= sizeof length) std::memcpy(&length, bytes.data(), sizeof length);
  EXPECT_EQ(bytes.size(), sizeof length + length);
  const auto read = [&](auto number) {
    std::vector<double> values(length / sizeof number);
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::memcpy(&number, bytes.data() + sizeof length + i * sizeof number, sizeof number);
      values[i] = static_cast<double>(number);
    }
    return values;
  };
  const std::string type = text.substr(tag, at - tag);
  if (type.find("Float64") != std::string::npos) return read(double{});
  if (type.find("Int32") != std::string::npos) return read(std::int32_t{});
  return read(std::uint8_t{});
}

}  // namespace antilock::test
