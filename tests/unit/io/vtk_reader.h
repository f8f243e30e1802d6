#pragma once

#include "ephyra/base/exceptions.h"
#include "temporary_folder.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace ephyra::testing
{
  /// Decodes the appended arrays of a VTK XML file.
  struct VtkReader
  {
    explicit VtkReader(const std::string &file_name)
      : text(read_whole_file(file_name))
    {
    }

    template <typename T>
    std::vector<T>
    array(const std::string &name) const
    {
      const std::size_t element = text.find("Name=\"" + name + "\"");
      const std::size_t offset  = text.find("offset=\"", element) + 8;
      const std::size_t start = text.find('_', text.find("<AppendedData")) + 1 +
                                std::stoul(text.substr(offset, 20));
      if (element == std::string::npos || start >= text.size())
        throw InputError("no array " + name);
      const auto number = [&](const std::size_t k) {
        std::uint64_t x;
        std::memcpy(&x, text.data() + start + 8 * k, 8);
        return x;
      };
      const std::uint64_t n_blocks = number(0);
      std::string         bytes;
      std::size_t         at = start + 8 * (3 + n_blocks);
      for (std::uint64_t block = 0; block < n_blocks; ++block)
        {
          const bool  last = block + 1 == n_blocks && number(2) > 0;
          std::string buffer(last ? number(2) : number(1), '\0');
          uLongf      size = buffer.size();
          if (uncompress(reinterpret_cast<Bytef *>(buffer.data()),
                         &size,
                         reinterpret_cast<const Bytef *>(text.data() + at),
                         number(3 + block)) != Z_OK ||
              size != buffer.size())
            throw InputError("block of " + name + " is damaged");
          bytes += buffer;
          at += number(3 + block);
        }
      std::vector<T> values(bytes.size() / sizeof(T));
      std::memcpy(values.data(), bytes.data(), bytes.size());
      return values;
    }

    const std::string text;
  };
} // namespace ephyra::testing
