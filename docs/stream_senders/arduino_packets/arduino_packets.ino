// Sends frames of a 4 x 4 pad as packets of 24 bytes and two bytes per taxel.
// The other end: palpate record --stream /dev/ttyACM0 --baud 1000000 --hand FOLDER -o pad.palpate
const int kRows = 4;
const int kColumns = 4;
const uint8_t kFrameU16 = 1;
uint32_t frameNumber = 0;
uint32_t crc = 0;

// Replace this by your sensor: here a row is driven, and the columns are read.
int readTaxel(int row, int column) {
  digitalWrite(2 + row, HIGH);
  int value = analogRead(column);
  digitalWrite(2 + row, LOW);
  return value;
}

// Sends a byte and takes it into the checksum (CRC-32 as of zlib, four bits at a time).
void sendByte(uint8_t value) {
  static const uint32_t kTable[16] = {
      0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4,
      0x4DB26158, 0x5005713C, 0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C,
      0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};
  crc = kTable[(crc ^ value) & 0x0F] ^ (crc >> 4);
  crc = kTable[(crc ^ (value >> 4)) & 0x0F] ^ (crc >> 4);
  Serial.write(value);
}

// Sends the lowest `bytes` bytes, the lowest first.
void sendNumber(uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) sendByte((uint8_t)(value >> (8 * i)));
}

void setup() {
  Serial.begin(1000000);
  for (int row = 0; row < kRows; ++row) pinMode(2 + row, OUTPUT);
}

void loop() {
  Serial.write((uint8_t)0xA5);
  Serial.write((uint8_t)0x5A);
  crc = 0xFFFFFFFF;
  sendByte(1);  // version
  sendByte(kFrameU16);
  sendNumber(2 * kRows * kColumns, 4);
  sendNumber(frameNumber++, 4);
  sendNumber(micros(), 8);  // may wrap after 71 minutes: the receiver knows that
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      sendNumber((uint64_t)readTaxel(row, column), 2);
  const uint32_t checksum = ~crc;
  sendNumber(checksum, 4);
}
