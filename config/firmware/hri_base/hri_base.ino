// Firmware of a small base with two driven wheels, for any Arduino and for the Pico.
//
// It speaks the text protocol of ROSArduinoBridge: a letter, up to two numbers, a carriage return;
// the answer is one line. What the letters mean is in the table at `carry_out`. A line may end with a
// check, ` *` and two hexadecimal digits; then its answer does, too. The board looks after
// itself as well: without a new velocity it stops after AUTO_STOP_MS, it does not drive ahead while
// a bumper is pressed or a cliff sensor sees no floor, and not at all while the stop switch is
// pressed, whoever asks for it.
//
// Wiring and calibration: README.md beside this folder.

#include <Arduino.h>

// --- what your base looks like: change this ---

const long BAUD = 57600;

// Left wheel, right wheel.
const int PWM_PINS[2] = {5, 6};          // speed of the motor
const int DIRECTION_PINS[2] = {4, 7};    // LOW is ahead
const int ENCODER_A_PINS[2] = {2, 3};    // need to be interrupt pins: 2 and 3 of an Uno
const int ENCODER_B_PINS[2] = {8, 9};
const bool IS_MOTOR_REVERSED[2] = {false, false};
const bool IS_ENCODER_REVERSED[2] = {false, false};

// Bumpers: switches from a digital pin to ground.
const int BUMPER_PINS[] = {10, 11};

// Stop switch: normally closed, from a digital pin to ground. It opens when it is pressed, and so
// does a broken wire. NONE for none.
const int NONE = -1;
const int STOP_PIN = 12;

// Cliff sensors: infrared, looking down, on analog inputs (0 is A0). Less than CLIFF_COUNTS of
// light that comes back is no floor.
const int CLIFF_INPUTS[] = {0, 1};
const int CLIFF_COUNTS = 200;

const int FRAME_RATE = 30;               // control frames a second; `m` counts in them
const unsigned long AUTO_STOP_MS = 500;
const unsigned long ECHO_MICROSECONDS = 6000;  // of a sonar: a meter there and back

// Gains, as the command `u` sets them: each frame changes the power by
// (KP error - KD change + KI sum of errors) / KO. A wheel starts with FEED for each count a frame.
int KP = 20, KD = 12, KI = 0, KO = 50;
const int FEED = 2;
const int MOST_POWER = 255;

// --- the wheels ---

volatile long counts[2] = {0, 0};

struct Wheel {
  int target;       // counts a frame
  long before;      // counts at the last frame
  int speed;        // counts in the last frame
  long sum;         // of errors, while the power has room
  int power;
};

Wheel wheels[2];
unsigned long commanded_at = 0;
unsigned long next_frame = 0;

void turned(int side) {
  const bool is_ahead = digitalRead(ENCODER_A_PINS[side]) == digitalRead(ENCODER_B_PINS[side]);
  counts[side] += (is_ahead != IS_ENCODER_REVERSED[side]) ? 1 : -1;
}

void left_turned() { turned(0); }
void right_turned() { turned(1); }

long counted(int side) {
  noInterrupts();  // four bytes do not come at once
  const long value = counts[side];
  interrupts();
  return value;
}

void set_power(int side, long wanted) {
  const int power = (int)constrain(wanted, (long)-MOST_POWER, (long)MOST_POWER);
  wheels[side].power = power;
  const bool is_ahead = (power >= 0) != IS_MOTOR_REVERSED[side];
  digitalWrite(DIRECTION_PINS[side], is_ahead ? LOW : HIGH);
  analogWrite(PWM_PINS[side], abs(power));
}

void aim(int side, int target) {
  Wheel &wheel = wheels[side];
  if (target == 0 || (target > 0) != (wheel.target > 0)) {
    wheel.sum = 0;
    set_power(side, (long)FEED * target);
  }
  wheel.target = target;
}

void control(int side) {
  Wheel &wheel = wheels[side];
  const long now = counted(side);
  const int speed = (int)(now - wheel.before);
  const int change = speed - wheel.speed;
  wheel.before = now;
  wheel.speed = speed;
  if (wheel.target == 0) {
    set_power(side, 0);
    return;
  }
  const long error = wheel.target - speed;
  const long step = (KP * error - (long)KD * change + KI * wheel.sum) / (KO ? KO : 1);
  const long wanted = wheel.power + step;
  if (labs(wanted) <= MOST_POWER) wheel.sum = constrain(wheel.sum + error, -1000L, 1000L);
  set_power(side, wanted);
}

// --- what it feels by itself ---

int input_pin(int number) {
  return number < 8 ? A0 + number : number;
}

bool is_in_danger() {
  for (int pin : BUMPER_PINS)
    if (digitalRead(pin) == LOW) return true;
  for (int number : CLIFF_INPUTS)
    if (analogRead(input_pin(number)) < CLIFF_COUNTS) return true;
  return false;
}

bool is_stopped() {
  return STOP_PIN != NONE && digitalRead(STOP_PIN) == HIGH;
}

void drive(int left, int right) {
  const bool is_ahead = (long)left + right > 0;
  const bool may_go = !is_stopped() && !(is_ahead && is_in_danger());
  aim(0, may_go ? left : 0);
  aim(1, may_go ? right : 0);
  commanded_at = millis();
}

void protect() {
  const bool is_ahead = (long)wheels[0].target + wheels[1].target > 0;
  const bool is_silent = millis() - commanded_at > AUTO_STOP_MS;
  if (is_silent || is_stopped() || (is_ahead && is_in_danger())) {
    aim(0, 0);
    aim(1, 0);
  }
}

int ping(int pin) {
  pinMode(pin, OUTPUT);
  digitalWrite(pin, LOW);
  delayMicroseconds(2);
  digitalWrite(pin, HIGH);
  delayMicroseconds(10);
  digitalWrite(pin, LOW);
  pinMode(pin, INPUT);
  return (int)(pulseIn(pin, HIGH, ECHO_MICROSECONDS) / 58);  // microseconds for a centimeter
}

// --- the protocol ---

const int LONGEST = 40;
char line[LONGEST + 1];
int length = 0;
bool is_too_long = false;

void set_gains(const char *text) {
  int *gains[] = {&KP, &KD, &KI, &KO};
  for (int *gain : gains) {
    *gain = atoi(text);
    const char *colon = strchr(text, ':');
    if (colon == NULL) return;
    text = colon + 1;
  }
}

// --- checks: the CRC-8 (polynomial 0x07) of all that stands before ` *` ---

const int CHECK_SIZE = 4;
// After a weighty line with a check, and for so long after any other, weighty ones need a check.
const unsigned long CHECKED_MS = 2000;
unsigned long checked_at = 0;
bool needs_checks = false;

uint8_t crc_of(const char *text, int size) {
  uint8_t crc = 0;
  for (int i = 0; i < size; i++) {
    crc ^= (uint8_t)text[i];
    for (int bit = 0; bit < 8; bit++) crc = (crc & 0x80) ? (uint8_t)(crc << 1) ^ 0x07 : crc << 1;
  }
  return crc;
}

char digit(uint8_t number) { return number < 10 ? '0' + number : 'A' + number - 10; }

bool has_check(const char *text, int size) {
  return size >= CHECK_SIZE && text[size - CHECK_SIZE] == ' ' && text[size - CHECK_SIZE + 1] == '*';
}

bool is_whole(const char *text, int size) {
  const uint8_t crc = crc_of(text, size - CHECK_SIZE);
  return text[size - 2] == digit(crc >> 4) && text[size - 1] == digit(crc & 15);
}

// --- what is asked ---

char answer[32];

void say(const char *text) { strcpy(answer, text); }
void say(long number) { snprintf(answer, sizeof answer, "%ld", number); }

void carry_out(const char *command) {
  const char *first_word = strchr(command, ' ');
  const char *second_word = first_word ? strchr(first_word + 1, ' ') : NULL;
  const int first = first_word ? atoi(first_word + 1) : 0;
  const int second = second_word ? atoi(second_word + 1) : 0;
  const bool is_refused = strchr("cpwx", command[0]) && is_kept(first);
  say("OK");
  switch (is_refused ? 0 : command[0]) {
    case 'a': say(analogRead(input_pin(first))); break;
    case 'b': snprintf(answer, sizeof answer, " %ld", BAUD); break;
    case 'c': pinMode(first, second == 1 ? OUTPUT : INPUT); break;
    case 'd': say(digitalRead(first)); break;
    case 'e': snprintf(answer, sizeof answer, "%ld %ld", counted(0), counted(1)); break;
    case 'm': drive(first, second); break;
    case 'p': say(ping(first)); break;
    case 'r': reset(); break;
    case 'u': if (first_word) set_gains(first_word + 1); break;
    case 'w':
      // On an input it switches the pull-up, as it does by itself on boards of the first years.
      if (is_bumper(first)) pinMode(first, second ? INPUT_PULLUP : INPUT);
      else digitalWrite(first, second ? HIGH : LOW);
      break;
    case 'x': analogWrite(first, second); break;
    default: say("Invalid Command");
  }
}

bool is_weighty(const char *command) { return command[0] && strchr("mrux", command[0]); }

// Whether a line without a check may be one that was damaged, and has weight. A stop is a stop.
bool is_doubtful(const char *command) {
  return needs_checks && is_weighty(command) && strcmp(command, "m 0 0");
}

void run(char *command, int size) {
  if (millis() - checked_at >= CHECKED_MS) needs_checks = false;
  const bool is_checked = !is_too_long && has_check(command, size);
  bool is_good = !is_too_long;
  if (is_checked) {
    is_good = is_whole(command, size);
    command[size - CHECK_SIZE] = '\0';
    if (is_good && is_weighty(command)) needs_checks = true;
    if (is_good) checked_at = millis();
  } else if (is_doubtful(command)) {
    is_good = false;
  }
  carry_out(is_good ? command : "");
  if (is_checked) {
    const int end = strlen(answer);
    const uint8_t crc = crc_of(answer, end);
    const char check[] = {' ', '*', digit(crc >> 4), digit(crc & 15), '\0'};
    strcat(answer, check);
  }
  Serial.println(answer);
}

// Pins that no command may touch: what turns the wheels has to go through `drive`, which looks after
// the base, and nobody may talk the stop switch out of it.
bool is_kept(int pin) {
  for (int side = 0; side < 2; side++)
    if (pin == PWM_PINS[side] || pin == DIRECTION_PINS[side]) return true;
  return pin == STOP_PIN;
}

bool is_bumper(int pin) {
  for (int its_pin : BUMPER_PINS)
    if (pin == its_pin) return true;
  return false;
}

void reset() {
  noInterrupts();
  counts[0] = counts[1] = 0;
  interrupts();
  wheels[0].before = wheels[1].before = 0;
}

void hear() {
  while (Serial.available() > 0) {
    const char letter = (char)Serial.read();
    if (letter == '\n') continue;
    if (letter == '\r') {
      line[length] = '\0';
      run(line, length);
      length = 0;
      is_too_long = false;
    } else if (length < LONGEST) {
      line[length++] = letter;
    } else {
      is_too_long = true;
    }
  }
}

void setup() {
  Serial.begin(BAUD);
#if defined(ARDUINO_ARCH_RP2040) || defined(ARDUINO_ARCH_ESP32)
  analogReadResolution(10);
#endif
  for (int side = 0; side < 2; side++) {
    pinMode(PWM_PINS[side], OUTPUT);
    pinMode(DIRECTION_PINS[side], OUTPUT);
    pinMode(ENCODER_A_PINS[side], INPUT_PULLUP);
    pinMode(ENCODER_B_PINS[side], INPUT_PULLUP);
    set_power(side, 0);
  }
  for (int pin : BUMPER_PINS) pinMode(pin, INPUT_PULLUP);
  if (STOP_PIN != NONE) pinMode(STOP_PIN, INPUT_PULLUP);
  attachInterrupt(digitalPinToInterrupt(ENCODER_A_PINS[0]), left_turned, CHANGE);
  attachInterrupt(digitalPinToInterrupt(ENCODER_A_PINS[1]), right_turned, CHANGE);
}

void loop() {
  hear();
  protect();
  if ((long)(millis() - next_frame) >= 0) {
    next_frame += 1000 / FRAME_RATE;
    control(0);
    control(1);
  }
}
