// What an import says of its plan: the reasons of notes and refusals as sentences, and what a file
// and a hand have, in words. Private to this module.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/imports/import_plan.h"

#include "imports/column_choice.h"

namespace palpate {

// Why something is noted or refused: a sentence, in which %1 to %9 stand for values, $1 for one in
// quotes, ~1 for one that may be cut.
struct Reason {
  std::string_view sentence;
};
std::string sentenceOf(Reason reason, std::initializer_list<std::string> values);

namespace reason {
// Values and their units. %1: what they are of the hand.
constexpr Reason kScaledByFile{"%1: ~2 is scaled as its scale_factor and add_offset say"};
constexpr Reason kMissingValue{
    "%1: %2 in ~3 is a missing value, as its _FillValue or missing_value says"};
constexpr Reason kNoUnit{"%1: the file gives no unit; the numbers are taken as %2"};
constexpr Reason kNoConversion{
    "%1: the unit $2 can't be converted to the hand's %3; give the scale and leave out the unit"};
constexpr Reason kOtherUnit{
    "%1: the file says $2, the hand says %3; the numbers are taken as they are"};
constexpr Reason kUnits{"%1: the columns have different units, each is converted by its own: %2"};
constexpr Reason kUsedTwice{"$1 is used twice"};
// Columns that the mapping names.
constexpr Reason kHandHasNone{"%1: the hand has none"};
constexpr Reason kOtherSamples{"%1: $2 is %3 per row, but the hand has %4"};
constexpr Reason kNoSuchMatrix{"the hand has no matrix %1, only %2"};
constexpr Reason kOtherNumbers{"$1 is %2 per row; expected %3"};
constexpr Reason kNothingMapped{"%1: nothing is mapped to it, its taxels are 0"};
constexpr Reason kTaxelList{
    "is a list of active taxels, as palpate convert writes it: its columns can't be chosen"};
constexpr Reason kTaxelListOfComponents{
    "is a list of active taxels with one value each, but the hand has three components per taxel; "
    "convert the recording to .h5 or .npz instead"};
// Rows and columns of a matrix.
constexpr Reason kOtherShape{
    "%1 has as many numbers as %2, but different rows and columns; save it as frames x rows x "
    "columns, or as frames x taxels"};
constexpr Reason kAxesTransposed{
    "%1: $2 has columns x rows, as the names of its axes say, and is transposed"};
constexpr Reason kRowByRow{
    "%1: $2 is taken row by row; where MATLAB's (:) made it, use a mapping with \"order\": "
    "\"columns\""};
constexpr Reason kExchanged{
    "%1: $2: rows and columns are exchanged: the names fit the hand only so"};
constexpr Reason kTransposed{"%1: $2 has columns x rows in the file and is transposed"};
constexpr Reason kNamesTransposed{"%1: $2: the names count columns, then rows: transposed"};
constexpr Reason kOrderOfNames{
    "%1: $2: the numbers in the names are taken for row and column, in this order; choose another "
    "one by --matrix 'NAME{x}_{y}'"};
// Three components per taxel.
constexpr Reason kInterleaved{
    "%1: the numbers are taken as x, y, z of each taxel; --components planar: all x, then all y, "
    "then all z"};
constexpr Reason kComponentsInOrder{
    "%1: the taxels are taken in the order of the file, their components by the names"};
constexpr Reason kPatternComponents{
    "$1: a pattern has no place for the component of a taxel; choose the columns in their order "
    "(--matrix A..B --components interleaved)"};
// Which columns are which matrix.
constexpr Reason kBothFit{
    "both $1 and $2 could be %3; choose the columns of each matrix (--matrix)"};
constexpr Reason kOrderOfFile{
    "matrices: no names tell them apart; taken in the order of the file: %1 (--matrix NAME=COLUMNS "
    "chooses others)"};
constexpr Reason kNoFile{
    "no file has the name of the matrix $1; name the files after the matrices of the hand (%2), or "
    "choose the columns of each matrix (--matrix ~1='NAME*')"};
constexpr Reason kOtherFile{"$1 has %2 per row, but its matrix has %3"};
constexpr Reason kNothingFits{
    "no columns fit the hand $1, which has %2 (expected one column per taxel, or arrays of rows x "
    "%3); the file has %4"};
constexpr Reason kNotUsed{"not used: %1"};
// Further series.
constexpr Reason kChoosesInstead{"of the columns that became series, %1"};
constexpr Reason kSeriesName{
    "series $1: a name is a small letter, then small letters, digits or _, 40 characters at most; "
    "$2 would be one"};
constexpr Reason kSeriesTwice{"series $1: the name is taken; give another one"};
constexpr Reason kSeriesNoNumbers{"series $1: no column of numbers; there are %2"};
constexpr Reason kSeriesNoTimes{
    "series $1: no column of times was found; give the rate of its rows (--series-rate %1=HZ)"};
constexpr Reason kSeriesTooWide{
    "series $1: it has %2 columns, but a series has at most %3; save only those needed"};
// Which axis, and which rows, are the frames.
constexpr Reason kSameSizes{
    "the %1 axis of ~2 is taken for the frames, but the %3 one has the same size, %4; if the "
    "frames are that one, exchange them in the file"};
constexpr Reason kAxisByName{"the last axis of the arrays is the frames, as its name says"};
constexpr Reason kEitherAxis{
    "the frames may be the first or the last axis of the arrays: choose the first by --matrix "
    "NAME, or save them with the frames first"};
constexpr Reason kLastAxis{"the last axis of the arrays, of %1, is taken for the frames"};
constexpr Reason kOtherRows{"~1 has %2 rows, but ~3 has %4"};
constexpr Reason kSampleRows{"%1: the columns have different numbers of rows"};
constexpr Reason kNoTimes{"%1: no column of times has as many rows; not imported"};
constexpr Reason kRateOfFile{"time: the file gives a rate of %1 Hz"};
}  // namespace reason

// "joint angles" or "temperatures".
std::string samplesText(PlannedSeries::Kind kind);

// The rows and columns of a matrix: "14 x 6".
std::string matrixShape(const MatrixLayout& matrix);

// Which columns give values, and how: "m0: pad[0] to pad[5] (6 columns), x 0.1 [kPa]".
std::string valuesText(const std::vector<TableColumn>& columns,
                       const std::string& what,
                       const std::vector<TableElement>& elements,
                       const PlannedValue& value,
                       const std::string& unit);

// The names of the columns: "t, m0, m1 and 12 more".
std::string namesText(const std::vector<TableColumn>& columns);

// Why columns of a file hold no numbers, or have one name; empty: nothing of it.
std::string unusableText(const std::vector<TableColumn>& columns);

// What can be done where nothing fits: columns are chosen only where there are enough of them.
std::string formsText(const std::vector<TableColumn>& columns, const SensorLayout& layout);

}  // namespace palpate
