#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace ephyra::patterns
{
  /// What an entry of a parameter file allows.
  class PatternBase
  {
  public:
    virtual ~PatternBase() = default;
    virtual std::unique_ptr<PatternBase>
    clone() const = 0;
    /// Empty where @p text is allowed, else what is wrong with it, in words.
    virtual std::string
    error(const std::string &text) const = 0;
    /// The form of an entry that is checked and kept: file names become
    /// absolute (relative ones start at @p folder, that of the parameter file;
    /// where no such file is there, at the working folder), and where a formula
    /// is expected a number with a unit becomes a bare number in SI.
    virtual std::string
    resolve(const std::string &text, const std::string & /*folder*/) const
    {
      return text;
    }
    /// What is allowed, in words: "a length between 0 and 1 m".
    virtual std::string
    description() const = 0;
    /// Unit of the values, "" without one.
    virtual std::string
    unit() const
    {
      return "";
    }
  };

  /// A real number with a unit of the dimension of @p unit ("m", "Pa", "Hz",
  /// "kg/m^3", "" for none); a bare number is in @p unit, which is SI.
  class Double : public PatternBase
  {
  public:
    enum class Bounds
    {
      closed, ///< limits allowed
      open    ///< limits excluded
    };
    explicit Double(const std::string &unit = "",
                    double min    = -std::numeric_limits<double>::infinity(),
                    double max    = std::numeric_limits<double>::infinity(),
                    Bounds bounds = Bounds::closed);
    std::unique_ptr<PatternBase>
    clone() const override;
    std::string
    error(const std::string &text) const override;
    std::string
    description() const override;
    std::string
    unit() const override;

  private:
    std::string unit_text;
    double      min, max;
    Bounds      bounds;
  };

  /// A strictly positive number with a unit.
  inline Double
  Positive(const std::string &unit = "")
  {
    return Double(
      unit, 0., std::numeric_limits<double>::infinity(), Double::Bounds::open);
  }

  class Integer : public PatternBase
  {
  public:
    explicit Integer(int min = std::numeric_limits<int>::min(),
                     int max = std::numeric_limits<int>::max());
    std::unique_ptr<PatternBase>
    clone() const override;
    std::string
    error(const std::string &text) const override;
    std::string
    description() const override;

  private:
    int min, max;
  };

  class Bool : public PatternBase
  {
  public:
    std::unique_ptr<PatternBase>
    clone() const override;
    std::string
    error(const std::string &text) const override;
    std::string
    description() const override;
  };

  /// One of several words: Selection("fixed|moving").
  class Selection : public PatternBase
  {
  public:
    explicit Selection(const std::string &choices);
    std::unique_ptr<PatternBase>
    clone() const override;
    std::string
    error(const std::string &text) const override;
    std::string
    description() const override;

  private:
    std::vector<std::string> choices;
  };

  /// A list of items of one pattern, separated by commas.
  class List : public PatternBase
  {
  public:
    explicit List(
      const PatternBase &item,
      unsigned int       min_items = 0,
      unsigned int       max_items = std::numeric_limits<unsigned int>::max());
    List(const List &);
    std::unique_ptr<PatternBase>
    clone() const override;
    std::string
    error(const std::string &text) const override;
    std::string
    description() const override;
    std::string
    unit() const override;

  private:
    std::unique_ptr<PatternBase> item;
    unsigned int                 min_items, max_items;
  };

  /// A formula in the given variables, checked by muParser when it is read,
  /// e.g. Expression({"r", "t"}, "m/s"). pi is known. A number with a unit
  /// ("30 mm/s") is allowed too; the values of a formula are SI.
  class Expression : public PatternBase
  {
  public:
    explicit Expression(const std::vector<std::string> &variables,
                        const std::string              &unit = "");
    std::unique_ptr<PatternBase>
    clone() const override;
    std::string
    error(const std::string &text) const override;
    std::string
    resolve(const std::string &text, const std::string &folder) const override;
    std::string
    description() const override;
    std::string
    unit() const override;

  private:
    std::vector<std::string> variables;
    std::string              unit_text;
  };

  /// Any text, e.g. a file or folder name.
  class Anything : public PatternBase
  {
  public:
    std::unique_ptr<PatternBase>
    clone() const override;
    std::string
    error(const std::string &text) const override;
    std::string
    description() const override;
  };

  /// The name of an existing file, or nothing. Kept as an absolute path.
  class InputFile : public PatternBase
  {
  public:
    std::unique_ptr<PatternBase>
    clone() const override;
    std::string
    error(const std::string &text) const override;
    std::string
    resolve(const std::string &text, const std::string &folder) const override;
    std::string
    description() const override;
  };

  /// For patterns that read a number of a certain unit: "" where @p text has
  /// it, else what is wrong.
  std::string
  unit_error(const std::string &text, const std::string &unit);

  /// The absolute path of a file that a parameter file in @p folder names.
  std::string
  resolve_file(const std::string &name, const std::string &folder);
} // namespace ephyra::patterns
