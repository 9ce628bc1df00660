// Sends frames of a 4 x 4 pad as lines of text: number of the frame, time [ms], 16 values.
// The other end: palpate record --stream /dev/ttyACM0 --baud 115200 --hand FOLDER -o pad.palpate
const int kRows = 4;
const int kColumns = 4;
unsigned long frameNumber = 0;

// Replace this by your sensor: here a row is driven, and the columns are read.
int readTaxel(int row, int column) {
  digitalWrite(2 + row, HIGH);
  int value = analogRead(column);
  digitalWrite(2 + row, LOW);
  return value;
}

void setup() {
  Serial.begin(115200);
  for (int row = 0; row < kRows; ++row) pinMode(2 + row, OUTPUT);
}

void loop() {
  Serial.print("frame#");
  Serial.print(frameNumber++);
  Serial.print(',');
  Serial.print(millis());
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      Serial.print(',');
      Serial.print(readTaxel(row, column));
    }
  }
  Serial.print('\n');
}
