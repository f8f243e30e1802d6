#include "ephyra/io/vtk_xml.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/io/collective.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace ephyra::io
{
  namespace
  {
    constexpr std::size_t block_size = std::size_t(1) << 18;

    /// Compresses in blocks, behind the header that VTK expects: number of
    /// blocks, size of a block, size of the last one where it is shorter,
    /// compressed sizes.
    std::string
    compress_blocks(const void *data, const std::size_t n_bytes)
    {
      const auto *const bytes    = static_cast<const unsigned char *>(data);
      const std::size_t n_blocks = (n_bytes + block_size - 1) / block_size;
      std::vector<std::uint64_t> header = {
        n_blocks, block_size, n_bytes % block_size};
      std::string                blocks;
      std::vector<unsigned char> buffer(compressBound(block_size));
      for (std::size_t start = 0; start < n_bytes; start += block_size)
        {
          uLongf    size   = buffer.size();
          const int status = compress2(buffer.data(),
                                       &size,
                                       bytes + start,
                                       std::min(block_size, n_bytes - start),
                                       Z_BEST_SPEED);
          EphyraThrowIf(status != Z_OK,
                        InputError,
                        "zlib failed to compress VTK output (status "
                          << status << "): free some memory.");
          header.push_back(size);
          blocks.append(reinterpret_cast<const char *>(buffer.data()), size);
        }
      return std::string(reinterpret_cast<const char *>(header.data()),
                         header.size() * sizeof(std::uint64_t)) +
             blocks;
    }
  } // namespace

  VtkXml::VtkXml(const std::string &type)
    : type(type)
  {
    xml << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
        << "\" version=\"1.0\" byte_order=\"LittleEndian\""
        << " header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<"
        << type;
  }

  void
  VtkXml::add_array(const std::string &vtk_type,
                    const std::string &name,
                    const int          n_components,
                    const void        *data,
                    const std::size_t  n_bytes)
  {
    xml << "<DataArray type=\"" << vtk_type << "\" Name=\"" << xml_escape(name)
        << "\" NumberOfComponents=\"" << n_components
        << "\" format=\"appended\" offset=\"" << appended.size() << "\"/>\n";
    appended += compress_blocks(data, n_bytes);
  }

  void
  VtkXml::finish(const std::string &file_name)
  {
    xml << "</" << type << ">\n<AppendedData encoding=\"raw\">\n_";
    replace_file(file_name,
                 xml.str() + appended + "\n</AppendedData>\n</VTKFile>\n");
  }

  std::string
  xml_escape(const std::string &text)
  {
    std::string result;
    for (const char c : text)
      switch (c)
        {
        case '&':
          result += "&amp;";
          break;
        case '<':
          result += "&lt;";
          break;
        case '>':
          result += "&gt;";
          break;
        case '"':
          result += "&quot;";
          break;
        default:
          result += c;
        }
    return result;
  }
} // namespace ephyra::io
