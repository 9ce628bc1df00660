// Constants of the tactile controller's protocol, used by DsaServer.
#pragma once

#include <cstddef>

namespace palpate {

constexpr unsigned kDsaPreamble = 0xAA;
constexpr std::size_t kDsaHeaderBytes = 6;

// Packet ids.
constexpr unsigned kDsaFrame = 0x00;
constexpr unsigned kDsaController = 0x01;
constexpr unsigned kDsaSensor = 0x02;
constexpr unsigned kDsaAcquire = 0x03;
constexpr unsigned kDsaReadMask = 0x04;
constexpr unsigned kDsaDescriptor = 0x05;
constexpr unsigned kDsaLoop = 0x06;
constexpr unsigned kDsaState = 0x0A;
constexpr unsigned kDsaMatrix = 0x0B;
constexpr unsigned kDsaPropertiesRate = 0x0C;
constexpr unsigned kDsaSetProperties = 0x0D;
constexpr unsigned kDsaGetProperties = 0x0E;
constexpr unsigned kDsaSetSensitivity = 0x0F;
constexpr unsigned kDsaFeatures = 0x10;
constexpr unsigned kDsaGetSensitivity = 0x12;
constexpr unsigned kDsaSetThreshold = 0x13;
constexpr unsigned kDsaGetThreshold = 0x14;
constexpr unsigned kDsaWriteMask = 0xAB;

// Error codes.
constexpr unsigned kDsaSuccess = 0;
constexpr unsigned kDsaUnsupported = 5;
constexpr unsigned kDsaChecksumError = 11;
constexpr unsigned kDsaTooFewParameters = 12;
constexpr unsigned kDsaUnknownCommand = 13;
constexpr unsigned kDsaFormatError = 14;
constexpr unsigned kDsaAccessDenied = 15;
constexpr unsigned kDsaInvalidParameter = 23;
constexpr unsigned kDsaIndexOutOfBounds = 24;
constexpr unsigned kDsaRangeError = 27;

}  // namespace palpate
