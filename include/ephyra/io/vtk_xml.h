#pragma once

#include <cstddef>
#include <sstream>
#include <string>

namespace ephyra::io
{
  /// A VTK XML file with appended, zlib-compressed arrays (see the VTK file
  /// format, https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html).
  /// The description is streamed into `xml`; finish() puts the arrays behind.
  class VtkXml
  {
  public:
    /// @p type is "RectilinearGrid", "UnstructuredGrid" or "PolyData".
    explicit VtkXml(const std::string &type);

    std::ostringstream xml;

    /// Adds a DataArray element, and @p n_bytes of @p data to the appended
    /// part. @p vtk_type is "Float32", "Int64", ...
    void
    add_array(const std::string &vtk_type,
              const std::string &name,
              int                n_components,
              const void        *data,
              std::size_t        n_bytes);

    /// Closes the file and writes it; throws InputError.
    void
    finish(const std::string &file_name);

  private:
    const std::string type;
    std::string       appended;
  };

  /// Replaces the characters that XML reserves.
  std::string
  xml_escape(const std::string &text);
} // namespace ephyra::io
