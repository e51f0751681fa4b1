#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <memory>
#include <stdexcept>

#include "framework/record/checksum/certify.h"

namespace {

using presa::Certificate;

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* thing) const {
    Free(thing);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Cert = std::unique_ptr<X509, Freed<X509_free>>;
using Bio = std::unique_ptr<BIO, Freed<BIO_free_all>>;
using Signed = std::unique_ptr<PKCS7, Freed<PKCS7_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>>;

void require(bool good, const char* what) {
  if (good) return;
  char reason[256];
  ERR_error_string_n(ERR_get_error(), reason, sizeof reason);
  throw std::runtime_error(std::string("OpenSSL cannot ") + what + ": " + reason);
}

Bio reading(const std::string& text) { return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size()))); }

std::string textOf(const Bio& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

Key keyOf(const Certificate& from) {
  Key key(PEM_read_bio_PrivateKey(reading(from.key).get(), nullptr, nullptr, nullptr));
  require(key != nullptr, "read a private key");
  return key;
}

Cert certificateOf(const Certificate& from) {
  Cert certificate(PEM_read_bio_X509(reading(from.certificate).get(), nullptr, nullptr, nullptr));
  require(certificate != nullptr, "read a certificate");
  return certificate;
}

void extend(X509* certificate, X509* issuer, int kind, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value));
  require(extension && X509_add_ext(certificate, extension.get(), -1) == 1, "extend a certificate");
}

/// Issues a certificate for `key`. A null `issuer` means self-signed.
Certificate issue(const Key& key, const std::string& name, int days, X509* issuer, EVP_PKEY* issuer_key) {
  const Cert certificate(X509_new());
  require(certificate != nullptr, "make a certificate");
  X509* const cert = certificate.get();
  unsigned char serial[8];
  require(RAND_bytes(serial, sizeof serial) == 1, "draw a number");
  serial[0] = static_cast<unsigned char>((serial[0] & 0x7FU) | 1U);  // positive, not 0
  const std::unique_ptr<BIGNUM, Freed<BN_free>> number(BN_bin2bn(serial, sizeof serial, nullptr));
  require(number && BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(cert)) != nullptr, "number a certificate");
  X509_set_version(cert, 2);                                // zero-based: X.509 v3
  X509_gmtime_adj(X509_getm_notBefore(cert), -24L * 3600);  // tolerates clocks that differ by a day
  X509_gmtime_adj(X509_getm_notAfter(cert), 24L * 3600 * days);
  X509_NAME* const subject = X509_get_subject_name(cert);
  require(X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8, reinterpret_cast<const unsigned char*>(name.c_str()),
                                     -1, -1, 0) == 1,
          "name a certificate");
  X509* const signer = issuer != nullptr ? issuer : cert;
  require(X509_set_issuer_name(cert, X509_get_subject_name(signer)) == 1 && X509_set_pubkey(cert, key.get()) == 1,
          "fill a certificate");
  extend(cert, signer, NID_basic_constraints, issuer == nullptr ? "critical,CA:TRUE" : "critical,CA:FALSE");
  require(X509_sign(cert, issuer_key, EVP_sha256()) != 0, "sign a certificate");
  const Bio certificate_text(BIO_new(BIO_s_mem())), key_text(BIO_new(BIO_s_mem()));
  require(PEM_write_bio_X509(certificate_text.get(), cert) == 1 &&
              PEM_write_bio_PKCS8PrivateKey(key_text.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1,
          "write a certificate");
  return {textOf(key_text), textOf(certificate_text)};
}

Key newKey() {
  Key key(EVP_EC_gen("P-256"));
  require(key != nullptr, "make a key");
  return key;
}

Certificate authority(const std::string& name, int days) {
  const Key key = newKey();
  return issue(key, name, days, nullptr, key.get());
}

Certificate certify(const Certificate& by, const std::string& name, int days) {
  return issue(newKey(), name, days, certificateOf(by).get(), keyOf(by).get());
}

std::string sign(const Certificate& by, const std::string& text) {
  constexpr int kFlags = PKCS7_TEXT | PKCS7_DETACHED;
  const Bio in = reading(text);
  const Signed sealed(PKCS7_sign(certificateOf(by).get(), keyOf(by).get(), nullptr, in.get(), kFlags));
  require(sealed != nullptr, "sign a text");
  require(BIO_reset(in.get()) >= 0, "read a text again");
  const Bio out(BIO_new(BIO_s_mem()));
  require(SMIME_write_PKCS7(out.get(), sealed.get(), in.get(), kFlags) == 1, "write a signed text");
  return textOf(out);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const presa::CertifyPlugin presaCertify{authority, certify, sign};
